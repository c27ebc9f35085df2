"""Reports: one HTML file each, with every picture inside, that opens without a network.

Needs ``pip install 'forgetting[cli]'``.
"""

from forgetting.report.certificate import save_certificate
from forgetting.report.page import Block, Page, write
from forgetting.report.single import save

__all__ = ["Block", "Page", "save", "save_certificate", "write"]

"""Writes again all that is generated from the registries: stub, README table, table of coverage."""

import coverage
import readme
import stubs

if __name__ == "__main__":
    readme.write()
    coverage.write()
    stubs.STUB.write_text(stubs.stub(), encoding="utf-8")

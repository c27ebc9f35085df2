"""One thread and no surprises: import this before NumPy."""

from __future__ import annotations

import os

THREADS = 1
for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = str(THREADS)
# set for some other program, they hold a current OpenBLAS down
for variable in ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE"):
    os.environ.pop(variable, None)

# A few words that do whole things. The README, CI and people use the same ones.
#   make demo    set up, identify two measured records, print where the reports are
#   make test    set up, then format, lint, types, Rust tests, Python tests
#   make bench   speed beside Eigen, dlib, Numba, NumPy by hand, ... in a few minutes; bench-full: all peers
#                and sizes. For the C++ peers: a C++ compiler, and Debian's libeigen3-dev, libdlib-dev,
#                libopenblas0-pthread; without them the report says what is missing
#   make accuracy   one-step errors beside peers and the best that could have been chosen in hindsight, on the
#                records of the demo; RECORDS=folder for other ones, .csv or .parquet
#   make docs    the documentation, warnings and dead links as errors, in two minutes; with the playground, where
#                it is built
#   make web     the JavaScript module and the playground, tested in Chromium; installs what it needs with
#                Debian's apt-get, or says what is missing
#   make sdist   the source distribution, built without git and installed into an empty environment;
#                compiles everything, in some five minutes
#   make crates  what cargo would publish, in which order, without doing so; then the oldest Rust that is
#                promised compiles it, where rustup can get that
#   make spark   tests on Spark, with a cluster of two workers on this machine; needs a Java runtime, and sets up an
#                environment of its own in .venv-spark. FORGETTING_FULL=1 for all engines beside one another
#   make fuzz    random input for FUZZ_SECONDS a target (an hour), new seeds each time: estimators, saved
#                states, text files, formulas, clocks, tables of fleets
#   make soak    a billion samples through every rule of O(n^2), the default and the bank, in hours; goes on
#                where it was stopped; SOAK_ONLY=bank,subspace for some of them
#   make c       the C library: build it, install it into a folder of its own and test that. Needs a C and a
#                C++ compiler; uses CMake, pkg-config and valgrind if there are
#   make embedded   archives for microcontrollers, and the example in QEMU on each; installs what it needs
#                with apt-get, or says what is missing
#   make stubs   write again what is generated from the registries: stubs, README table, rule pages

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check -q
# Optimized, but quicker to build than a wheel: see Cargo.toml.
PROFILE := fast
# cargo has jobs of its own: rustdoc warns of those of `make -j` that it cannot join
CARGO := env -u MAKEFLAGS -u MFLAGS cargo
DEVELOP = . $(BIN)/activate && PIP_QUIET=1 maturin develop --quiet
# Two records inside wheels. Their own dependencies clash with ours and are not needed to read them, so
# they lie in a folder of their own, which only what reads them is shown.
SHIPPED := pvanalytics==0.2.2 sweat==0.25.0
WITH_RECORDS = PYTHONPATH=$(CURDIR)/$(VENV)/records

# PySpark has wishes of its own about pandas, so it has an environment of its own. It sees the package as built.
SPARK := .venv-spark

FUZZ_SECONDS ?= 3600
SOAK_STEPS ?= 1000000000
SOAK_FOLDER ?= $(CURDIR)/build/soak

# hundreds of processes are started: each would compile what it imports where bytecode is not kept
unexport PYTHONDONTWRITEBYTECODE

.PHONY: accuracy c crates embedded fuzz java soak spark demo test lint rust python build bench bench-full docs sdist stubs web clean

demo: $(VENV)/records
	$(DEVELOP) --profile $(PROFILE) --extras cli
	$(WITH_RECORDS) $(BIN)/forgetting demo all --output demo

test: lint rust python

lint: build
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --quiet -- -D warnings
	$(CARGO) clippy --package forgetting --no-default-features --quiet -- -D warnings
	$(CARGO) clippy --package forgetting --features serde --quiet -- -D warnings
	$(CARGO) clippy --package forgetting-c --features general --quiet -- -D warnings
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy

rust:
	$(CARGO) test --workspace --exclude forgetting-py --exclude forgetting-wasm --profile $(PROFILE) --quiet
	$(CARGO) test --package forgetting --features serde --test serde --profile $(PROFILE) --quiet

# one thread of BLAS for each process: as many as there are cores in each only wait for one another
python: build
	OPENBLAS_NUM_THREADS=1 $(WITH_RECORDS) $(BIN)/pytest -n auto --dist worksteal

build: $(VENV)/ready
	$(DEVELOP) --profile $(PROFILE)

$(VENV)/maturin:
	$(PYTHON) -m venv $(VENV)
	$(PIP) install --upgrade pip "maturin>=1.7,<2"
	touch $@

$(VENV)/records: $(VENV)/maturin
	$(PIP) install --no-deps --target $@ $(SHIPPED)

$(VENV)/ready: pyproject.toml $(VENV)/records
	cargo clippy --version >/dev/null && cargo fmt --version >/dev/null
	$(DEVELOP) --profile $(PROFILE) --extras cli,test
	touch $@

# the oldest Rust that is promised
OLDEST := $(shell sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
crates:
	$(CARGO) publish --workspace --exclude forgetting-py --dry-run --no-verify --allow-dirty
	if rustup toolchain install $(OLDEST) --profile minimal --no-self-update >/dev/null 2>&1; then \
	    $(CARGO) +$(OLDEST) check --quiet --package forgetting --features forgetting/serde \
	        --package forgetting-runtime --package forgetting-c --features forgetting-c/general; \
	    else echo "crates: not compiled with Rust $(OLDEST), which rustup cannot get here"; fi

c: build
	$(MAKE) --no-print-directory -C crates/forgetting-c test PYTHON=$(CURDIR)/$(BIN)/python

embedded: build
	+PYTHON=$(CURDIR)/$(BIN)/python sh crates/forgetting-c/embedded/run.sh

spark: java build $(SPARK)/ready
	OPENBLAS_NUM_THREADS=1 $(SPARK)/bin/python -m pytest --durations 5 tests/spark python/forgetting/spark

java:
	@$(PYTHON) tests/spark/java.py

$(SPARK)/ready: tests/spark/requirements.txt
	$(PYTHON) -m venv $(SPARK)
	$(SPARK)/bin/python -m pip --disable-pip-version-check -q install -r $<
	echo "$(CURDIR)/python" > "$$($(SPARK)/bin/python -c 'import site; print(site.getsitepackages()[0])')/forgetting.pth"
	touch $@

fuzz: build
	FUZZ_SECONDS=$(FUZZ_SECONDS) FUZZ_SEED=$$(date +%s) $(CARGO) test --package forgetting --profile $(PROFILE) \
	    --test fuzz --quiet -- --nocapture
	FUZZ_SECONDS=$(FUZZ_SECONDS) FUZZ_SEED=$$(date +%s) $(BIN)/pytest -s tests/fuzz

soak:
	SOAK_STEPS=$(SOAK_STEPS) SOAK_FOLDER=$(SOAK_FOLDER) SOAK_ONLY=$(SOAK_ONLY) $(CARGO) test --package forgetting \
	    --profile $(PROFILE) --test soak --quiet -- --nocapture

stubs: build
	$(BIN)/python tools/generate.py

$(VENV)/sphinx: $(VENV)/ready
	$(PIP) install sphinx myst-parser sphinx-gallery furo sphinx-design
	touch $@

docs: build $(VENV)/sphinx
	rm -rf docs/_build
	$(WITH_RECORDS) $(BIN)/sphinx-build -W -b html docs docs/_build
	cd docs && ../$(BIN)/python -m writing.links _build

# From a copy without git, as somebody has it who unpacked an archive.
SDIST := $(CURDIR)/build/sdist
sdist: $(VENV)/maturin
	rm -rf $(SDIST) && mkdir -p $(SDIST)/source
	tar -c --exclude=./.git --exclude=./target --exclude=./build --exclude='./.venv*' . | tar -x -C $(SDIST)/source
	cd $(SDIST)/source && GIT_CEILING_DIRECTORIES=$(SDIST) $(CURDIR)/$(BIN)/maturin sdist --out $(SDIST)
	$(PYTHON) -m venv $(SDIST)/empty
	$(SDIST)/empty/bin/python -m pip install --disable-pip-version-check -q $(SDIST)/forgetting-*.tar.gz
	cd $(SDIST) && empty/bin/python -c "import doctest, forgetting; assert not doctest.testmod(forgetting).failed; \
	    print(forgetting.__version__, forgetting.__file__)"

$(VENV)/playwright: $(VENV)/ready
	$(PIP) install playwright
	touch $@

web: build $(VENV)/playwright
	tools/web.sh build
	FORGETTING_WEB=1 $(WITH_RECORDS) $(BIN)/pytest tests/web

# what pip cannot install, the report names
PEERS = sed -e 's/ *\#.*//' -e '/^$$/d' $(1) | while read peer; do \
	$(PIP) install --no-warn-conflicts "$$peer" || echo "not installed: $$peer" >&2; done

accuracy: build
	$(call PEERS,benchmarks/requirements-accuracy.txt)
	$(WITH_RECORDS) $(BIN)/python -m benchmarks.accuracy $(RECORDS)

bench: $(VENV)/ready
	$(DEVELOP) --release
	$(call PEERS,benchmarks/requirements.txt)
	$(WITH_RECORDS) $(BIN)/python -m benchmarks --quick

bench-full: $(VENV)/ready
	$(DEVELOP) --release
	$(call PEERS,benchmarks/requirements.txt benchmarks/requirements-full.txt)
	$(WITH_RECORDS) $(BIN)/python -m benchmarks

clean:
	$(CARGO) clean
	rm -rf $(VENV) $(SPARK) demo build

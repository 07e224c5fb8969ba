# Every target makes its own .venv first; nothing is installed outside it.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

# Bytecode is kept whatever the shell says: the tests start a hundred interpreters, and each would
# compile numpy again.
export PYTHONDONTWRITEBYTECODE :=

.PHONY: typed demo test test-all test-release release-check lint bench bench-own peers pages docs format clean

$(VENV)/.made:
	$(PYTHON) -m venv $(VENV)
	touch $@

# One stamp for each set of extras, remade when pyproject.toml changes.
$(VENV)/.%: $(VENV)/.made pyproject.toml
	$(PIP) install --editable ".[$*]"
	touch $@

demo: $(VENV)/.all
	$(BIN)/contactkit run fuel-injector --out out/fuel-injector --overwrite

# The same every time and on every machine. There is a process for each core: threads of BLAS beside
# them wait for each other, and took 73 s of CPU instead of 57 s of some contacts and motions.
ONE_THREAD = OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
PYTEST = $(ONE_THREAD) $(BIN)/python -m pytest --numprocesses auto --dist worksteal
test: $(VENV)/.test
	$(PYTEST)

# And what takes long: the same every time too.
test-all: test $(VENV)/.test-all
	$(PYTEST) -m "slow and not exhaustive" --durations 25

# Before a release, half an hour: every case of the sweeps of which test-all runs some, then random
# examples. SEED=... repeats what a run explored.
SEED ?= $(shell date +%Y%m%d)
test-release: $(VENV)/.test-all
	$(PYTEST) -m exhaustive
	@echo "random examples from SEED=$(SEED)"
	$(PYTEST) -m hypothesis --hypothesis-profile=random --hypothesis-seed=$(SEED)

# Everything against other programs, some minutes, one table; `make pages PAGES=peers` puts it
# into docs/demands. Larger maps:
# .venv/bin/python tests/benchmarks/peers/compare.py --sizes 256 512 1024 2048 --areas 1 5 20 --budget 120
bench: $(VENV)/.test peers
	$(BIN)/python tests/benchmarks/peers/bench.py --peers $(VENV)/peers

# What each part of ours costs, without others.
bench-own: $(VENV)/.test
	$(BIN)/python -m pytest tests/benchmarks --benchmark-only --benchmark-disable-gc --benchmark-columns=min,median,max,rounds

# Generated pages, tables and pictures of docs, made again: all, some hours, or PAGES="films demands".
# .venv/bin/python docs/scripts/pages.py --list has the names, and how long each takes.
PAGES ?=
pages: $(VENV)/.test
	$(BIN)/python docs/scripts/pages.py $(PAGES)

# Other contact solvers, each in an environment of its own; what does not install is named with the reason.
peers: $(VENV)/.made
	$(BIN)/python tests/benchmarks/peers/install.py $(VENV)/peers

# mypy and the site read the package as it is installed, fmu/ and models/ inside it: links lay it
# out that way.
TYPED := build/typed/contactkit
typed:
	rm -rf $(TYPED)
	mkdir -p $(TYPED)
	ln -s $(CURDIR)/contactkit/* $(CURDIR)/fmu $(CURDIR)/models $(TYPED)
	ln -s $(CURDIR)/examples/gallery $(TYPED)/gallery

lint: $(VENV)/.lint typed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	cd build/typed && ../../$(BIN)/mypy --config-file ../../pyproject.toml -p contactkit

format: $(VENV)/.lint
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

# What is uploaded: sdist and wheel, complete and as an index shows them. RELEASING.md has the other steps.
release-check: $(VENV)/.test
	$(PIP) install build twine
	rm -rf build dist
	$(BIN)/python -m build
	$(BIN)/twine check --strict dist/*
	$(BIN)/python -m pytest -q -m "slow or not slow" tests/rules/test_packaging.py

docs: $(VENV)/.docs typed
	$(BIN)/mkdocs build --strict

clean:
	rm -rf $(VENV) build dist out site .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks

# Every target makes its own .venv first; nothing is installed outside it.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

.PHONY: demo test lint bench docs format clean

$(VENV)/.made:
	$(PYTHON) -m venv $(VENV)
	touch $@

# One stamp for each set of extras, remade when pyproject.toml changes.
$(VENV)/.%: $(VENV)/.made pyproject.toml
	$(PIP) install --editable ".[$*]"
	touch $@

demo: $(VENV)/.all
	$(BIN)/contactkit run fuel-injector --out out/fuel-injector

test: $(VENV)/.test
	$(BIN)/python -m pytest

bench: $(VENV)/.test
	$(BIN)/python -m pytest tests/benchmarks --benchmark-only --benchmark-disable-gc --benchmark-columns=min,median,max,rounds

# mypy reads the package as it is installed, fmu/ and models/ included, so it gets a copy laid out that way.
lint: $(VENV)/.lint
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	rm -rf build
	$(PIP) install --no-deps --no-build-isolation --target build/installed .
	cd build/installed && ../../$(BIN)/mypy --config-file ../../pyproject.toml -p contactkit

format: $(VENV)/.lint
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

docs: $(VENV)/.docs
	$(BIN)/mkdocs build --strict

clean:
	rm -rf $(VENV) build dist out site .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks

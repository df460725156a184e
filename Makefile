# Needs python3 (3.11 or newer) with venv, and make. Everything else goes into .venv.

PYTHON ?= python3
VENV ?= .venv
BIN := $(VENV)/bin
# The tests that do the same with compiled kernels and with plain ones.
ALIKE := .pytest_cache/alike.json
CONTROLS := syntec-mill fanuc-m meldas-m sinumerik-840d fanuc-0i-tf

# What machine code is made of.
KERNELS := $(wildcard build_kernels/*.py src/polycnc/kernels/*.py src/polycnc/motion/kernels/*.py \
  src/polycnc/language/bulk/*.py src/polycnc/toolpath/*.py src/polycnc/toolpath/columns/*.py src/polycnc/parquet/*.py)

.PHONY: help demo panel test test-plain kernels check fuzz bench features clean

help:
	@echo "make demo      install polycnc into $(VENV) and run every program of examples/"
	@echo "make panel     install the panel and open an example in the browser"
	@echo "make test      run all tests"
	@echo "make test-plain  behind it: with plain kernels, without tests that have been seen to use none"
	@echo "make kernels   compile the kernels of this source tree again, if they have changed"
	@echo "make check     lint, formatting, types, direction of imports"
	@echo "make fuzz      run COUNT mutated inputs on all cores, from number FIRST on (FIRST=0 COUNT=10000 SEED=1)"
	@echo "make bench     run the benchmarks"
	@echo "make features  renew the list of functions that work, in polycnc and in docs/controls"
	@echo "make clean     remove $(VENV) and what tools have left behind"

# One stamp for each set of extras: installed again when pyproject.toml or what is compiled has changed.
$(VENV)/.installed-%: pyproject.toml $(KERNELS)
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@echo "polycnc is installed into $(VENV); its kernels are compiled, which takes some minutes"
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.$(if $(filter-out plain,$*),[$*])'
	$(BIN)/python -m compileall -q "$(CURDIR)/src/polycnc"  # an editable installation leaves that to the first run
	touch $@

panel: $(VENV)/.installed-panel
	$(BIN)/polycnc panel examples/fanuc-m-bracket.nc --control fanuc-m --setup examples/fanuc-m-bracket.setup.yaml

# The name of an example begins with its control; a setup lies beside it.
demo: $(VENV)/.installed-plain
	@for control in $(CONTROLS); do \
	  for program in examples/$$control-*.nc examples/$$control-*.mpf; do \
	    test -f "$$program" || continue; \
	    setup="$${program%.*}.setup.yaml"; \
	    echo "== $$program"; \
	    $(BIN)/polycnc run "$$program" --control $$control $$(test -f "$$setup" && echo --setup "$$setup") || exit $$?; \
	  done; \
	done

test: $(VENV)/.installed-test
	$(BIN)/python -m pytest -n 2 --write-alike=$(ALIKE)

test-plain: $(VENV)/.installed-test
	POLYCNC_KERNELS=python $(BIN)/python -m pytest -n 2 --hypothesis-profile=brief --leave-out=$(ALIKE)

kernels: $(VENV)/.installed-test
	$(BIN)/python -m build_kernels

check: $(VENV)/.installed-test $(VENV)/.installed-check
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy --any-exprs-report .mypy_cache/report
	$(BIN)/python tests/any_exprs.py .mypy_cache/report/any-exprs.txt
	$(BIN)/python -m pytest tests/test_imports.py

FIRST ?= 0
COUNT ?= 10000
SEED ?= 1

fuzz: kernels
	$(BIN)/python -m tests.fuzz --seed $(SEED) --first $(FIRST) --count $(COUNT) $(FUZZ)

bench: $(VENV)/.installed-bench
	$(BIN)/python -m benchmarks

features: $(VENV)/.installed-test
	$(BIN)/polycnc features --from tests/conformance --format json --output src/polycnc/data/features.json
	$(BIN)/python -m pytest -m feature tests/panel --junitxml .pytest_cache/features.xml
	$(BIN)/polycnc features --tests .pytest_cache/features.xml --format json --output src/polycnc/data/tested.json
	for control in $(CONTROLS); do \
	  $(BIN)/polycnc features --control $$control --format markdown --lang en \
	    --output docs/controls/$$control-functions.md || exit $$?; \
	done

clean:
	rm -rf src/polycnc/kernels/compiled.* build $(VENV) .pytest_cache .mypy_cache .ruff_cache .hypothesis

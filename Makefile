# `make help` lists the targets. What a target needs beyond Rust and make, it installs itself under target/.

CARGO := cargo
ISOPHOTE := $(CARGO) run --quiet --release --
# The build that the tests use, so that nothing is compiled twice.
TESTED_BUILD := $(CARGO) build --quiet --workspace --lib --bins --tests
TESTED_DIR := $(or $(CARGO_TARGET_DIR),target)/debug
TESTED := $(TESTED_DIR)/isophote
PYTHON_ENV := target/python
PYTHON := $(CURDIR)/$(PYTHON_ENV)/bin/python
PYTHON_MODULE := python/isophote/_isophote.abi3.so
GENERATED := target/generated
DOCS_ENV := target/docs-python
DOCS_SITE := target/docs-site
# The scenes of docs/gallery.md that are all rendered the same way.
GALLERY := solids room mesh spheres shadows overcast spot color sun orthographic fisheye panorama
# gungraun requires a runner of its own version.
GUNGRAUN := 0.20.0
GUNGRAUN_RUNNER := target/gungraun/bin/gungraun-runner
FUZZ_TARGETS := $(notdir $(basename $(wildcard fuzz/fuzz_targets/*.rs)))
FUZZ_SECONDS := 60

.DEFAULT_GOAL := help
.PHONY: help demo test test-python test-wasm check lint check-python check-wasm app test-app bench-app bench bench-python bench-instructions compare growth trials audit fuzz docs generate generated-is-current

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-18s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: ## Render the lab's scene: its numbers, lab.png, and lab-figure.png with axes and isophotes
	$(ISOPHOTE) render -o lab.png --figure lab-figure.png

test: python-env ## Run every test (those that use Python need 3.10 or later)
	@if [ -e $(PYTHON_ENV)/ready ]; then export ISOPHOTE_PYTHON="$(PYTHON)"; fi; \
	$(CARGO) test --workspace
	@command -v node >/dev/null || echo "no Node here: the tests as WebAssembly are skipped"
	@$(MAKE) --no-print-directory test-node-and-python

.PHONY: test-node-and-python
test-node-and-python: $(if $(shell command -v node),test-wasm) $(if $(wildcard $(PYTHON_ENV)/ready),test-python)

BROWSER := wasm32-unknown-unknown
# A library that Rust can link too, as the app's is, gets no link-time optimisation; without it the tests use the same core.
IN_BROWSER := CARGO_PROFILE_DIST_LTO=off CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="-C target-feature=+simd128"
WASM_TEST := $(IN_BROWSER) CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER="node $(CURDIR)/validation/wasm/run.mjs" \
	$(CARGO) test --profile dist --target $(BROWSER) -p isophote-wasm --test conformance
APP_MODULE := $(or $(CARGO_TARGET_DIR),target)/$(BROWSER)/dist/isophote_web.wasm

test-wasm: test-wasm-build ## Run the conformance suite as the app's WebAssembly (needs Node 20 or later; installs the Rust target)
	$(WASM_TEST)

# After the app's module, whose core it tests.
.PHONY: test-wasm-build
test-wasm-build: check-wasm
	$(WASM_TEST) --no-run

check-wasm: ## Build the core for browsers
	@rustup target list --installed 2>/dev/null | grep -qx $(BROWSER) || rustup target add $(BROWSER)
	$(IN_BROWSER) $(CARGO) build --profile dist --target $(BROWSER) -p isophote-web

app: check-wasm web/node_modules/.package-lock.json ## Build the app: web/dist/site, a folder for any web server, and web/dist/isophote.html, one file (needs Node 20 or later)
	CARGO_TARGET_DIR=target/bindgen $(CARGO) run --quiet --locked --manifest-path web/bindgen/Cargo.toml -- $(APP_MODULE) web/src/engine/wasm
	cd web && npm run --silent build
	@cmp -s web/dist/one-file/index.html web/dist/isophote.html && [ -e web/dist/isophote.html.gz ] || { \
		cp web/dist/one-file/index.html web/dist/isophote.html && \
		gzip --best --no-name --force --keep web/dist/isophote.html; }

web/node_modules/.package-lock.json: web/package-lock.json
	@command -v npm >/dev/null || { echo "Node is missing: install version 20 or later, with npm, by your system's package manager"; exit 1; }
	cd web && npm ci --loglevel error --no-fund --no-audit
	@touch $@

CHROMIUM := $(or $(ISOPHOTE_CHROMIUM),/usr/bin/chromium)

test-app: app ## Check and test the app, with Chromium in a browser too
	cd web && npm run --silent check && npm run --silent test
	$(TESTED_BUILD)
	@if [ -x "$(CHROMIUM)" ]; then cd web && ISOPHOTE="$(CURDIR)/$(TESTED)" npm run --silent e2e; \
	else echo "no Chromium at $(CHROMIUM): the tests of the page in a browser are skipped"; fi

bench-app: app ## Time the app in a browser: first visit, change to picture, kernel beside the native one
	cd web && npx playwright test --config bench.config.ts

test-python: python-env python-module ## Run the tests of the Python package alone
	cd python && PYTHONPATH="$(CURDIR)/python" $(PYTHON) -m pytest

check: lint generated-is-current check-python check-wasm ## Formatting, lints, documentation without warnings, generated files up to date

lint: ## Check the formatting, the lints and the documentation of the Rust code
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets -- -D warnings
	$(CARGO) clippy --workspace --bench instructions -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps --quiet

check-python: python-env python-module ## Check the Python package: formatting, lints, types, stubs of the compiled module
	@[ -e $(PYTHON_ENV)/ready ] || exit 0; cd python && \
	$(PYTHON) -m ruff format --check --quiet . && $(PYTHON) -m ruff check --quiet . && \
	$(PYTHON) -m mypy && $(PYTHON) -m mypy.stubtest isophote._isophote --mypy-config-file pyproject.toml && \
	$(PYTHON) -m basedpyright --pythonpath $(PYTHON)

bench: ## Time every stage and the whole program from start to picture, then compare with other programs
	$(CARGO) bench --workspace
	@$(MAKE) --no-print-directory bench-python
	@$(MAKE) --no-print-directory compare

bench-python: ## Time the Python package as pip installs it: calls, loading, points, sweeps compared with Numba
	rm -rf target/bench-python && python3 -m venv target/bench-python
	target/bench-python/bin/python -m pip install --quiet --disable-pip-version-check ".[xarray]" numba
	target/bench-python/bin/python validation/python/speed.py

compare: ## Compare with NumPy, Numba, Dr.Jit, Mitsuba, Radiance and POV-Ray, and write docs/speed.md (40 minutes)
	python3 validation/speed/compare.py
	python3 validation/speed/other_scenes.py

growth: ## Measure how the cost grows with spheres and samples, and write docs/growth.md (5 minutes)
	python3 validation/growth/growth.py

trials: ## Try mutated files, kills, signals, full disks and files meant to take long (10 minutes; TRIALS="--count 30 kills")
	$(CARGO) build --quiet --release -p isophote-cli
	python3 validation/trials/trials.py $(or $(CARGO_TARGET_DIR),target)/release/isophote $(TRIALS)

bench-instructions: ## Count the instructions of every stage (needs valgrind; installs gungraun-runner)
	@command -v valgrind >/dev/null || { echo "valgrind is missing: install it by your system's package manager"; exit 1; }
	@[ -x $(GUNGRAUN_RUNNER) ] || $(CARGO) install --locked --root target/gungraun gungraun-runner@$(GUNGRAUN)
	GUNGRAUN_RUNNER="$(CURDIR)/$(GUNGRAUN_RUNNER)" $(CARGO) bench --workspace --bench instructions

audit: ## Check licences, sources and bans of all dependencies (installs cargo-deny if it is missing)
	@$(CARGO) deny --version >/dev/null 2>&1 || $(CARGO) install --locked cargo-deny
	$(CARGO) deny check licenses sources bans

# Inputs found by a run are kept under target/; fuzz/corpus holds only small seeds. The memory limit catches headers
# that lie.
fuzz: ## Feed damaged files to every reader, for FUZZ_SECONDS=60 each (installs cargo-fuzz and a nightly Rust)
	@rustup run nightly rustc --version >/dev/null 2>&1 || rustup toolchain install nightly --profile minimal
	@$(CARGO) fuzz --version >/dev/null 2>&1 || $(CARGO) install --locked cargo-fuzz
	@for target in $(FUZZ_TARGETS); do \
		echo "$$target:"; \
		mkdir -p target/fuzz-corpus/$$target; \
		$(CARGO) +nightly fuzz run --target-dir target/fuzz $$target target/fuzz-corpus/$$target fuzz/corpus/$$target -- \
			-max_total_time=$(FUZZ_SECONDS) -timeout=10 -malloc_limit_mb=256 -print_final_stats=1 -verbosity=0 || exit 1; \
	done

docs: generate docs-site ## Regenerate generated files; build the site of docs/, and the documentation of the library
	$(CARGO) doc --workspace --no-deps
	@echo "guide: $(DOCS_SITE)/index.html; library: target/doc/isophote/index.html"

# Examples and notebooks need the package: notebooks run while the site is built. Warnings are errors.
.PHONY: docs-site
docs-site: python-module $(DOCS_ENV)/ready
	$(DOCS_ENV)/bin/python -m sphinx -W --keep-going -n -q -b html -d target/docs-doctrees docs $(DOCS_SITE)

$(DOCS_ENV)/ready: docs/requirements.txt
	rm -rf $(DOCS_ENV) && mkdir -p target && python3 -m venv $(DOCS_ENV)
	$(DOCS_ENV)/bin/python -m pip install --quiet --disable-pip-version-check -r docs/requirements.txt
	touch $@

# The tutorial's pictures, drawn by its own examples; look at them before committing.
.PHONY: docs-figures
docs-figures: python-module $(DOCS_ENV)/ready ## Redraw the tutorial's pictures
	PYTHONPATH=python $(DOCS_ENV)/bin/python python/tests/test_docs.py

generate: ## Rewrite the generated files: schema/, docs/images/ (the gallery too)
	@$(MAKE) --no-print-directory $(GENERATED)
	cp -r $(GENERATED)/. .

generated-is-current: $(GENERATED)
	@cd $(GENERATED) && find . -type f | while read -r file; do \
		cmp -s "$$file" "$(CURDIR)/$$file" || { echo "$$file is out of date: run make generate"; exit 1; }; \
	done

.PHONY: $(GENERATED)
$(GENERATED):
	$(TESTED_BUILD)
	@rm -rf $@ && mkdir -p $@/schema $@/docs/images
	$(TESTED) schema > $@/schema/scene.schema.json
	$(TESTED) render --quiet --figure $@/docs/images/lab.png > /dev/null
	$(TESTED) render --quiet scenes/two-lights.toml --figure $@/docs/images/two-lights.png > /dev/null
	$(TESTED) section --quiet --row 300 -c brightness -c diffuse -c specular \
		-o $@/docs/images/lab-section.png
	@mkdir -p $@/docs/images/gallery
	for scene in $(GALLERY); do \
		$(TESTED) render --quiet scenes/$$scene.toml --size 400x300 --figure $@/docs/images/gallery/$$scene.png \
			> /dev/null || exit 1; \
	done
	$(TESTED) surface --quiet scenes/surface.toml --figure $@/docs/images/gallery/surface.png > /dev/null
	$(TESTED) grid --quiet scenes/grid.toml --name floor --figure $@/docs/images/gallery/grid.png > /dev/null

# The compiled part of the Python package, placed where Python finds it in the source tree.
.PHONY: python-module
python-module:
	$(TESTED_BUILD)
	@for module in $(TESTED_DIR)/lib_isophote.so $(TESTED_DIR)/lib_isophote.dylib; do \
		[ ! -e "$$module" ] || cmp -s "$$module" $(PYTHON_MODULE) || { rm -f $(PYTHON_MODULE); cp "$$module" $(PYTHON_MODULE); }; \
	done

# Without Python, the tests of its package do not run, two others report that they are skipped, and everything else
# runs.
.PHONY: python-env
python-env:
	@cmp -s python/requirements-dev.txt $(PYTHON_ENV)/ready || { \
		rm -rf $(PYTHON_ENV) && mkdir -p target && python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))' && \
		python3 -m venv $(PYTHON_ENV) && \
		$(PYTHON) -m pip install --quiet --disable-pip-version-check -r python/requirements-dev.txt && \
		cp python/requirements-dev.txt $(PYTHON_ENV)/ready; \
	} || { rm -rf $(PYTHON_ENV); echo "no Python from 3.10 with its packages here: the tests that need it are skipped"; }

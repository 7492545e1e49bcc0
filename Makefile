# `make help` lists what can be made. Everything a target needs beyond Rust and make it installs itself, under target/.

CARGO := cargo
ISOPHOTE := $(CARGO) run --quiet --release --
PYTHON_ENV := target/python
GENERATED := target/generated

.DEFAULT_GOAL := help
.PHONY: help demo test check bench audit docs generate generated-is-current

help: ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-10s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: ## Render the lab's scene: its numbers, lab.png, and lab-figure.png with axes and isophotes
	$(ISOPHOTE) render -o lab.png --figure lab-figure.png

test: python-env ## Run every test (with NumPy, zarr and xarray as foreign readers, where Python 3 can have them)
	@if [ -e $(PYTHON_ENV)/readers-ready ]; then export ISOPHOTE_PYTHON="$$PWD/$(PYTHON_ENV)/bin/python"; fi; \
	$(CARGO) test --workspace

check: generated-is-current ## Formatting, lints, documentation without warnings, generated files up to date
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps --quiet

bench: ## Time every stage, and the whole program from start to picture
	$(CARGO) bench --workspace

audit: ## Licences, sources and bans of all dependencies (installs cargo-deny if it is missing)
	@$(CARGO) deny --version >/dev/null 2>&1 || $(CARGO) install --locked cargo-deny
	$(CARGO) deny check licenses sources bans

docs: generate ## Regenerate what is generated, and build the documentation of the library
	$(CARGO) doc --workspace --no-deps
	@echo "guide: README.md and docs/; library: target/doc/isophote/index.html"

generate: ## Make the generated files anew: schema/, docs/images/
	@$(MAKE) --no-print-directory $(GENERATED)
	cp -r $(GENERATED)/. .

generated-is-current: $(GENERATED)
	@cd $(GENERATED) && find . -type f | while read -r file; do \
		cmp -s "$$file" "$(CURDIR)/$$file" || { echo "$$file is out of date: run make generate"; exit 1; }; \
	done

.PHONY: $(GENERATED)
$(GENERATED):
	@rm -rf $@ && mkdir -p $@/schema $@/docs/images
	$(CARGO) run --quiet -- schema > $@/schema/scene.schema.json
	$(CARGO) run --quiet -- render --quiet --figure $@/docs/images/lab.png > /dev/null
	$(CARGO) run --quiet -- render --quiet scenes/two-lights.toml --figure $@/docs/images/two-lights.png > /dev/null
	$(CARGO) run --quiet -- section --quiet --row 300 -c brightness -c diffuse -c specular \
		-o $@/docs/images/lab-section.png

# NumPy, zarr and xarray read what we write for them. Without them two tests say that they are skipped, and all others run.
.PHONY: python-env
python-env:
	@[ -e $(PYTHON_ENV)/readers-ready ] || { \
		rm -rf $(PYTHON_ENV) && mkdir -p target && python3 -m venv $(PYTHON_ENV) && \
		$(PYTHON_ENV)/bin/python -m pip install --quiet --disable-pip-version-check numpy 'zarr>=3' xarray && \
		touch $(PYTHON_ENV)/readers-ready; \
	} || { rm -rf $(PYTHON_ENV); echo "no Python with NumPy, zarr and xarray here: the tests that need them are skipped"; }

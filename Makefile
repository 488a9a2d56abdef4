# `make` lists the targets. Each installs, builds and computes what it needs and is missing.
.DEFAULT_GOAL := help

# A figure is a module that draws it and an experiment of the same name: the paper's, then research of one's own.
DRAWN := $(filter $(basename $(notdir $(wildcard experiments/*.json))),$(basename $(notdir $(wildcard python/bristle/figures/*.py))))
FIGURES := $(sort $(filter fig%,$(DRAWN)))
STUDIES := $(sort $(filter-out fig%,$(DRAWN)))
.PHONY: help packages build test bench accuracy clean figures findings guide assumptions report archive verify citation deposit release \
  sanitize fuzz format tidy coverage $(FIGURES) $(STUDIES)
JOBS ?= $(shell nproc 2>/dev/null || echo 1)
BUILD := build
# TIER=smoke computes a small subset of the points, in seconds.
TIER ?= full
SUFFIX := $(if $(filter full,$(TIER)),,-$(TIER))
# The figures are drawn into files, whatever the shell has set.
export MPLBACKEND := agg
# A terminal shows how far the build is, on one line; a log has only what fails.
export NINJA_STATUS := [%f/%t] 
NINJA := ninja -C $(BUILD) -j $(JOBS) $(shell test -t 2 || echo --quiet)
export PYTHONPATH := $(CURDIR)/python$(if $(PYTHONPATH),:$(PYTHONPATH))
PLOT_PYTHON := scripts/find-python numpy h5py matplotlib xarray h5netcdf

help: ## list the targets
	@echo "bristle: friction of a bristle lattice under a sliding slab"
	@sed -n 's/^\([a-z%][a-z0-9 %-]*\):.*## \(.*\)/\1\t\2/p' $(MAKEFILE_LIST) | \
	  while IFS="$$(printf '\t')" read -r target text; do printf '  make %-12s %s\n' "$$target" "$$text"; done
	@echo "  make FIG          make one figure: results/FIG.h5, figures/FIG.pdf and .png, and the claims' verdicts"
	@echo "FIG is one of $(FIGURES), $(STUDIES). TIER=smoke makes a quick, coarse one."

packages: ## install the missing Debian packages (root or sudo)
	@scripts/install-packages

$(BUILD)/build.ninja: CMakeLists.txt CMakePresets.json | packages
	@scripts/quietly cmake --preset release -G Ninja

build: packages $(BUILD)/build.ninja ## build the program: build/bristle
	@test -x $(BUILD)/bristle || echo "Building the program, one to two minutes on two cores ..."
	@$(NINJA) bristle

PREFIX ?= /usr/local
.PHONY: install package
install: build ## the program with all that it needs into PREFIX=/usr/local (docs/running.md)
	@scripts/quietly cmake --install $(BUILD) --prefix $(PREFIX) --strip
	@echo "Installed $(PREFIX)/bin/bristle"

package: build ## a Debian package of the program: dist/bristle_<version>_<architecture>.deb
	@scripts/install-packages package
	@cd $(BUILD) && ../scripts/quietly cpack -G DEB
	@ls dist/bristle_*.deb

$(FIGURES) $(STUDIES): %: build
	@$(MAKE) --no-print-directory compute-$*
	@$(MAKE) --no-print-directory draw-$*

.PHONY: $(addprefix compute-,$(FIGURES) $(STUDIES)) $(addprefix draw-,$(FIGURES) $(STUDIES))
$(addprefix compute-,$(FIGURES) $(STUDIES)): compute-%:
	@test -e results/$*$(SUFFIX).h5 || echo "Computing $*, $(if $(SUFFIX),some seconds,some minutes) on two cores ..."
	$(BUILD)/bristle run experiments/$*.json --tier $(TIER) -o results/$*$(SUFFIX).h5

$(addprefix draw-,$(FIGURES) $(STUDIES)): draw-%:
	@$$($(PLOT_PYTHON)) -m bristle.current $* results/$*$(SUFFIX).h5 figures$(SUFFIX) || \
	  scripts/plot $* results/$*$(SUFFIX).h5 -o figures$(SUFFIX)
	@$(if $(filter design,$*),scripts/plot drawing results/design$(SUFFIX).h5 -o figures$(SUFFIX) && \
	  $(BUILD)/bristle export results/design$(SUFFIX).h5 --group drawing,true)
	@echo "The paper's claims (docs/claims.md), and deviations from the reference (CONTRIBUTING.md):"
	@$(BUILD)/bristle check --report-only results/$*$(SUFFIX).h5

figures: build ## make all figures
	@scripts/overlapped "$(MAKE) --no-print-directory" $(FIGURES)

# The images of the documents have fewer pixels than those in figures/.
IMAGES := $(filter $(FIGURES) $(STUDIES),$(basename $(notdir $(wildcard docs/images/*.png))))
.PHONY: images tutorial
images: $(IMAGES) bristles ## docs/images: the figures in the documents
	@for name in $(IMAGES); do scripts/plot $$name results/$$name.h5 $$([ $$name != fig4 ] || echo --maps-only) \
	    --format png --dpi 160 -o $(BUILD)/images && \
	  cp $(BUILD)/images/$$name.png docs/images/ || exit; done
	@scripts/plot drawing results/design.h5 --format png --dpi 160 -o docs/images
	@scripts/plot bristles results/bristles.h5 --animate -o docs/images

tutorial: build ## docs/tutorial.ipynb: executes the cells, stores what they print and draw
	@$$($(PLOT_PYTHON)) -m bristle.pages.tutorial

# Studies with checks: the findings of this project, and a claim of the conclusions.
CHECKED_STUDIES := load liftoff bouncing hysteresis scatter chart tuning
findings: figures $(CHECKED_STUDIES) ## all figures; docs/findings.md, each claim with its verdict and numbers; README's summary
	@$$($(PLOT_PYTHON)) -m bristle.pages.findings $(patsubst %,results/%$(SUFFIX).h5,$(FIGURES) $(CHECKED_STUDIES)) $(if $(SUFFIX),-o results/findings$(SUFFIX).md,--readme README.md)

assumptions: build ## every claim under every alternative to what the paper leaves open: docs/assumptions.md, reference/assumptions.json
	@test -e results/assumptions.json || echo "Computing the claims under other assumptions, about half an hour on two cores ..."
	$(BUILD)/bristle assumptions
	@$$($(PLOT_PYTHON)) -m bristle.pages.assumptions results/assumptions.json
	@cp results/assumptions.json reference/

guide: design ## docs/your-own-brush.md: what `make design` finds
	@$$($(PLOT_PYTHON)) -m bristle.pages.guide results/design$(SUFFIX).h5

report: figures $(STUDIES) report-packages ## one page of all figures, claims, limits and sources: report/index.html
	@$$($(PLOT_PYTHON) jinja2) -m bristle.report $(patsubst %,results/%$(SUFFIX).h5,$(FIGURES) $(STUDIES)) -o report$(SUFFIX)/index.html

# The page's engine is compiled by Emscripten, in a folder of its own (docs/running.md).
PAGE := build-page
PRESETS := ski seal paper
.PHONY: page page-engine page-points page-agreement
page-engine:
	@scripts/install-packages page
	@scripts/quietly cmake -S page -B $(PAGE) -G Ninja -DCMAKE_BUILD_TYPE=Release \
	  -DCMAKE_TOOLCHAIN_FILE=$$(em-config EMSCRIPTEN_ROOT)/cmake/Modules/Platform/Emscripten.cmake
	@test -e $(PAGE)/engine.wasm || echo "Compiling the page's engine, some minutes on two cores ..."
	@ninja -C $(PAGE) --quiet -j $(JOBS) engine

# Points that the page has: its presets, and those of Figure 4.
page-points: build
	@for name in $(PRESETS); do file=page/presets/$$name.json; test -e $$file || file=experiments/$$name.json; \
	  $(BUILD)/bristle run $$file -o $(PAGE)/$$name.h5 --quiet 2>/dev/null || exit; done
	@$(BUILD)/bristle run experiments/fig4.json --tier smoke -o $(PAGE)/fig4.h5 --quiet

page: report-packages page-engine page-points ## a brush in the browser: page/brush.html, one file (docs/running.md)
	@$$($(PLOT_PYTHON) jinja2) page/page.py $(PAGE) --program $(BUILD)/bristle -o page/brush.html

# What docs/generated/accuracy.md says of the page.
AGREEING := fig4 fig7 fig8 load ski
page-agreement: report-packages page-engine page-points
	@for name in $(AGREEING); do $(BUILD)/bristle run experiments/$$name.json --tier smoke -o $(PAGE)/$$name-smoke.h5 --quiet 2>/dev/null || exit; done
	@$$($(PLOT_PYTHON)) page/agreement.py $(PAGE)/engine.wasm $(AGREEING:%=$(PAGE)/%-smoke.h5) $(PRESETS:%=$(PAGE)/%.h5)

# The tests are configured into the same build folder; the program is not compiled again.
$(BUILD)/tests/CTestTestfile.cmake: tests/CMakeLists.txt benchmarks/CMakeLists.txt | test-packages
	@scripts/quietly cmake --preset release -G Ninja -DBRISTLE_TESTS=ON
	@touch $@  # CMake does not write it again if its text is the same

.PHONY: test-packages build-tests test test-all
test-packages:
	@scripts/install-packages test

build-tests: test-packages $(BUILD)/tests/CTestTestfile.cmake
	@test -x $(BUILD)/tests/unit_tests || echo "Building program and tests, three to five minutes on two cores ..."
	@$(NINJA) bristle unit_tests

.PHONY: report-packages
report-packages:
	@scripts/install-packages report

# Property tests draw 25 random cases here, and 100 in `make test-all`.
test: build-tests ## what every commit needs: minutes
	@RC_PARAMS="max_success=25" scripts/run-ctest $(BUILD) -L '^(unit.*|commit)$$'

test-all: ## everything, nightly and before a release: sanitizers, fuzzers, other compiler, all figures, documents
	@scripts/install-packages test test-all page
	@$(MAKE) --no-print-directory build-tests
	@$(NINJA) bench_engine bench_quadrature scipy_slopes accuracy
	@scripts/run-ctest $(BUILD)

bench: build report-packages ## benchmarks: ratios against peers in the same run, into docs/generated/performance.md
	@scripts/install-packages bench
	@scripts/quietly cmake --preset release -G Ninja  # finds peers that have just been installed
	@$(NINJA) bench_engine bench_quadrature scipy_slopes
	@mkdir -p $(BUILD)/bench
	$(BUILD)/benchmarks/bench_engine >$(BUILD)/bench/engine.json
	$(BUILD)/benchmarks/bench_quadrature >$(BUILD)/bench/quadrature.json
	$$($(PLOT_PYTHON)) benchmarks/scipy_peer.py $(BUILD)/benchmarks/libscipy_slopes.so >$(BUILD)/bench/scipy.json
	$$($(PLOT_PYTHON)) scripts/time_experiments.py $(BUILD)/bristle $(FIGURES:%=experiments/%.json) >$(BUILD)/bench/figures.json
	$$($(PLOT_PYTHON)) scripts/time_build.py >$(BUILD)/bench/build.json
	$$($(PLOT_PYTHON) jinja2) scripts/time_commands.py $(BUILD)/bristle >$(BUILD)/bench/commands.json
	@$$($(PLOT_PYTHON)) -m bristle.pages.performance $(BUILD)/bench

accuracy: build ## errors of the methods, measured: docs/generated/accuracy.md
	@$(NINJA) accuracy
	@mkdir -p $(BUILD)/bench
	$(BUILD)/benchmarks/accuracy >$(BUILD)/bench/accuracy.json
	@$$($(PLOT_PYTHON)) -m bristle.pages.accuracy $(BUILD)/bench/accuracy.json

.PHONY: archive-check archive-matrix
MISSING = $(strip $(foreach name,$(FIGURES) $(STUDIES),$(if $(wildcard results/$(name)$(SUFFIX).h5),,$(name))))
archive-check: build
	@$(BUILD)/bristle archive --check --tier $(TIER)
	@test -z "$(MISSING)" || echo "To be computed first, at most $(if $(SUFFIX),two minutes,half an hour) of processor time: $(MISSING)." \
	  "Ctrl-C keeps what is computed, and the same command continues."

# The recorded matrix, which takes half an hour to compute; the archive refuses it if an experiment has changed since.
archive-matrix: build
	@mkdir -p results && cp -n reference/assumptions.json results/

# What an archive refuses is refused before anything is computed or drawn.
archive: archive-check figures $(STUDIES) report $(if $(SUFFIX),,archive-matrix) ## one citable file of all results: dist/bristle-<version>.tar
	$(BUILD)/bristle archive --tier $(TIER) --figures figures$(SUFFIX) --report report$(SUFFIX)/index.html

# ARCHIVE=FILE is another archive, RERUN=N computes N of its points again.
ARCHIVE ?= dist/bristle-$(shell sed -n 's/^version: //p' CITATION.cff).tar
verify: build ## check the archive; RERUN=N also computes N points again and compares every bit
	$(BUILD)/bristle verify $(ARCHIVE) $(if $(RERUN),--rerun $(RERUN))

# Zenodo reads .zenodo.json.
citation: packages report-packages ## write .zenodo.json from CITATION.cff, after every change of that file
	@$$($(PLOT_PYTHON) yaml) -m bristle.pages.zenodo

deposit: packages report-packages ## what Zenodo asks about the archive: dist/bristle-<version>.tar.zenodo.json
	@$$($(PLOT_PYTHON) yaml) -m bristle.pages.zenodo --archive $(ARCHIVE)
	@echo "$(ARCHIVE).zenodo.json: written"

release: packages report-packages ## VERSION=x.y.z [DOI=10.x/y]: write the new version and its DOI everywhere, commit nothing
	@scripts/release '$(VERSION)' '$(DOI)'

# These have build folders of their own; CONTRIBUTING.md describes what they look for.
SANITIZER ?= address
CHECKED := $(if $(filter thread,$(SANITIZER)),thread,sanitize)
# Unit tests that start no thread have nothing to find for the sanitizer of threads (tests/unit/main.cpp).
UNITS := $(if $(filter thread,$(SANITIZER)),unit_threads,unit.*)
# Sanitizers look at the code and not at the physics, so property tests draw 5 random cases.
sanitize: test-packages ## unit tests, shell tests and smoke runs under the sanitizers of SANITIZER=address (and undefined), or thread
	cmake --preset $(CHECKED) -G Ninja
	ninja -C build-$(CHECKED) --quiet -j $(JOBS) bristle unit_tests
	RC_PARAMS="max_success=5" scripts/run-ctest build-$(CHECKED) -L '^($(UNITS)|shell|smoke)$$'

fuzz: SECONDS ?= 60
fuzz: packages ## the readers of files on random changes of tests/fuzz/corpus, SECONDS=60 for each kind
	@scripts/install-packages test-all
	tests/fuzz/run.sh . build-fuzz $(SECONDS)

# CONTRIBUTING.md describes the parts of the campaign.
.PHONY: stress
stress: SECONDS ?= 600
stress: build test-packages report-packages ## random physics, damaged files, archives and pages, kills, failing calls, Slurm: SECONDS=600
	@$$(scripts/find-python numpy h5py matplotlib xarray h5netcdf jinja2) tests/stress/run.py $(BUILD)/bristle --seconds $(SECONDS) $(if $(SEED),--seed $(SEED))

format: ## C++ files as .clang-format says
	@scripts/install-packages format
	@scripts/format

# SINCE=REVISION limits it to the source files that changed since then.
tidy: packages ## clang-tidy over src/ with the checks of .clang-tidy; SINCE=REV: over what changed since REV
	@scripts/install-packages test-all
	scripts/tidy build-tidy $(JOBS) $(SINCE)

# The files that differ from the upstream branch; without one, or on it, those of the last commit.
.PHONY: tidy-changed
tidy-changed:
	@$(MAKE) --no-print-directory tidy SINCE=$$(scripts/changed-since)

coverage: test-packages ## the lines of src/ that unit tests and shell tests execute: at least 90 %
	@scripts/install-packages test-all
	cmake --preset coverage -G Ninja
	ninja -C build-coverage --quiet -j $(JOBS) bristle unit_tests
	find build-coverage -name '*.gcda' -delete
	scripts/run-ctest build-coverage -L '^(unit.*|shell)$$'
	gcovr --root . --filter src/ --object-directory build-coverage --print-summary --fail-under-line 90

clean: ## remove what was built; results and figures stay
	rm -rf $(BUILD) build-*

# SPDX-License-Identifier: LGPL-3.0-or-later
# What can be done with a clone, a target each. JOBS=4 builds with four jobs.
JOBS ?= 2
GMSH ?= 0
PETSC ?= 0
SHELLS ?= 0
READERS ?= 0
CCX ?= 0
CGX ?= 0
BROWSER ?= 0
# The sources of a module compiled as one: half the time from nothing. UNITY=OFF where sources change.
UNITY ?= ON
CLANG_TIDY ?= clang-tidy
CCACHE := $(shell command -v ccache)
LAUNCHER := $(if $(CCACHE),-DCMAKE_CXX_COMPILER_LAUNCHER=$(CCACHE))
SCRATCH := build/installed
SOURCES = $(shell find src apps python tests bench -name '*.hpp' -o -name '*.cpp' 2>/dev/null)

.PHONY: help deps configure build build-profile demo picture test test-mpi installed-test debug-test verify figures bench deb deb-test site format lint clean
.DEFAULT_GOAL := help
.NOTPARALLEL:

help: ## what there is
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1 \2/p' $(MAKEFILE_LIST) | awk '{name = $$1; sub(/^[^ ]* /, ""); printf "make %-12s %s\n", name, $$0}'

deps: ## install what is missing (GMSH=1: libgmsh too; PETSC=1: PETSc for iterative solvers and several processes; SHELLS=1: zsh, fish and man, READERS=1: VTK, meshio and h5py, CCX=1: CalculiX, CGX=1: its GraphiX too, BROWSER=1: Chromium, for tests)
	@GMSH=$(GMSH) PETSC=$(PETSC) SHELLS=$(SHELLS) READERS=$(READERS) CCX=$(CCX) CGX=$(CGX) BROWSER=$(BROWSER) cmake/install-dependencies

configure:
	@cmake --preset release -DRUBATO_UNITY=$(UNITY) -DRUBATO_RUNS_ONLY=OFF $(LAUNCHER)

build: configure ## build/release/rubato
	@cmake/build --preset release -j$(JOBS)

build-profile: ## what the last build spent its time on: ten objects, ten headers
	@cmake/build-profile build/release

# A first build for the demo leaves out what its run does without; a later one takes what there is.
demo: deps ## two beams rub: tip history and checks
	@cmake --preset release -DRUBATO_UNITY=$(UNITY) $(LAUNCHER) $(if $(wildcard build/release/CMakeCache.txt),,-DRUBATO_RUNS_ONLY=ON)
	@cmake/build --preset release -j$(JOBS) --target rubato_cli
	build/release/rubato run cases/sdnl140/f.yaml --only evol1 -o out/demo
	@printf '\nout/demo/evol1/probes.csv, the tip of the upper beam [s, m]:\n'
	@awk -F, '{for (i = 1; i <= NF; ++i) printf "%-24s", $$i; print ""}' out/demo/evol1/probes.csv

picture: build ## docs/pictures/*.png from runs (python3-matplotlib; BROWSER=1 for report.png)
	build/release/rubato run cases/sdnl140/f.yaml --only evol1 -o out/picture --set mesh.refine=4 --set time.step=2e-4 \
	  --set time.start=consistent --set fields.at=[0.0032] --set checks=
	/usr/bin/python3 docs/pictures/draw_beams.py out/picture/evol1 0.0032 docs/pictures/beams.png
	RUBATO_PICTURES=$(abspath docs/pictures) RUBATO_PROGRAM=$(abspath build/release/rubato) RUBATO_SOURCE_DIR=$(abspath .) \
	  /usr/bin/python3 -m pytest -q -rs -p no:cacheprovider tests/browser/report_page_test.py -k pictures

test: deps build ## every test, and a program built against the installed package
	ctest --preset release -j$(JOBS)
	@awk '/^\[  SKIPPED \] .*ms\)$$/ && !seen[$$4]++ {print "not run here: " $$4}' build/release/Testing/Temporary/LastTest.log
	@awk '/^\[=+\] [0-9]+ tests? from .* ran/ {n += $$2} END {print n " tests ran"}' build/release/Testing/Temporary/LastTest.log
	@$(MAKE) --no-print-directory installed-test

test-mpi: PETSC := 1
test-mpi: deps build ## runs by several processes of mpiexec against the same runs by one (PETSc)
	ctest --preset release -L '^mpi$$'

installed-test:
	@cmake -E rm -rf $(SCRATCH)
	@cmake --install build/release --prefix $(SCRATCH)/prefix > $(SCRATCH).log
	@cmake -G Ninja -S tests/consumer -B $(SCRATCH)/consumer -DCMAKE_PREFIX_PATH=$(abspath $(SCRATCH)/prefix) >> $(SCRATCH).log 2>&1 \
	  || { cat $(SCRATCH).log; false; }
	@cmake --build $(SCRATCH)/consumer
	ctest --test-dir $(SCRATCH)/consumer --output-on-failure
	$(SCRATCH)/prefix/bin/rubato --help > $(SCRATCH).log
	@test -s $(SCRATCH)/prefix/share/man/man1/rubato.1

debug-test: deps ## the tests under the address and undefined-behaviour sanitizers
	@cmake --preset debug -DRUBATO_UNITY=$(UNITY) $(LAUNCHER)
	@cmake --build --preset debug -j$(JOBS)
	ctest --preset debug -j$(JOBS)

deb: deps configure ## Debian packages of program, library and Python module, into build/packages
	@cmake/install-dependencies dpkg-dev file
	@cmake --build --preset release -j$(JOBS) --target rubato_cli rubato rubato_shell_files rubato_python
	@cmake -E rm -rf build/packages
	@cpack --config build/release/CPackConfig.cmake -B build/packages > build/packages.log || { tail -20 build/packages.log; false; }
	@ls build/packages/*.deb

deb-test: ## the packages in a clean Debian 12 in build/deb-test (as root; from Debian's packages)
	@cmake/install-dependencies debootstrap
	@cmake/test-packages build/packages build/deb-test

site: deps ## the pages as a web site, into build/site
	@docs/make-site build/site
	@echo build/site/index.html

verify: build ## the slow studies of docs/verification, their figures, and 50 runs killed at any moment
	@cmake --build --preset release --target verify
	@RUBATO_KILLS=50 build/release/tests/restart/restart --gtest_brief=1 --gtest_filter='*KilledRun*'
	@$(MAKE) --no-print-directory figures

figures: ## docs/verification/*.svg from the runs that verify left
	@cmake/install-dependencies python3-matplotlib
	/usr/bin/python3 docs/verification/draw_histories.py build/release/verification/sdnl140 docs/verification \
	  $(wildcard $(or $(RUBATO_SHARED),../shared)/sdnl140/code_aster)

bench: build ## kernels and whole studies, into docs/performance.md (an hour)
	@cmake --build --preset release --target bench

format: ## clang-format every source
	@clang-format -i $(SOURCES)

lint: ## clang-format and clang-tidy find nothing to say
	@clang-format --dry-run -Werror $(SOURCES)
	@cmake -E make_directory build
	@cmake --preset release -B build/lint -DRUBATO_UNITY=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > build/lint.log # GCC's are not Clang's
	@CLANG_TIDY=$(CLANG_TIDY) cmake/tidy build/lint $(JOBS)

clean: ## forget everything built
	@cmake -E rm -rf build

# Everything a developer types. CMake and its presets do the work; `make help` lists the targets.
.DEFAULT_GOAL := all
.NOTPARALLEL:
JOBS ?= $(shell nproc)
# Many tests wait for a period or a peer: one more than cores keeps the cores busy.
TEST_JOBS ?= $(shell expr $(JOBS) + 1)
PREFIX ?= /usr/local
# On a shared integration machine ($CI is set there) a test that failed gets a second try; `make test` lists these tests and
# those that were skipped, and fails there if they are too many (tests/lint/check_run.py).
CTEST = ctest --test-dir build --output-on-failure --no-tests=error -j $(TEST_JOBS) $(if $(CI),--repeat until-pass:2)

.PHONY: all with-tests demo test quick soak rt-proof target-proof deb-proof container container-proof fuzz check-deps install-deps sanitize asan-ubsan tsan tidy format bench bench-peers docs deb apt arm64 arm64-test install uninstall clean help

all: check-deps ## build into build/, programs in build/bin/
	@cmake --preset release --log-level=WARNING $(without_tests) >/dev/null
	@cmake --build --preset release -j $(JOBS)

# Tests, and the packages they need, come with the first `make test` and then stay.
without_tests = $(if $(wildcard build/CMakeCache.txt),,-DINDUROP_BUILD_TESTS=OFF)

with-tests:
	@.ci/install-deps build test
	@cmake --preset release --log-level=WARNING -DINDUROP_BUILD_TESTS=ON >/dev/null
	@cmake --build --preset release -j $(JOBS)

SHOWN = PATH="$(CURDIR)/build/bin:$$PATH" INDUROP_STATE_DIR="$(CURDIR)/build/demo"
demo: ## install what is missing, build what it shows, run the chapter's example, a plant of two boards, the robot cell
	@.ci/install-deps build
	@cmake --preset release --log-level=WARNING $(without_tests) >/dev/null
	@cmake --build --preset release -j $(JOBS) --target demo_programs
	@$(SHOWN) examples/chapter/demo.sh
	@$(SHOWN) examples/two_boards/demo.sh
	@$(SHOWN) examples/robot_cell/demo.sh

test: with-tests ## install what is missing, build, run all tests and lints
	@rm -rf build/tests/state; ls /dev/shm >build/shared_memory
	@$(CTEST) -LE 'tidy|soak|proof_long|million|target' -O $(CURDIR)/build/ctest.log --output-junit $(CURDIR)/build/ctest.xml; code=$$?; \
	  python3 tests/lint/check_run.py build/ctest.xml build/ctest.log build/shared_memory || code=1; exit $$code

quick: with-tests ## unit and golden tests only
	@$(CTEST) -L 'unit|golden'

soak: T = 20m
soak: with-tests ## a plant of three boards for T (T=20m, 2h): what grows; the store read 10^9 times; a loop of 100 us; as root
	@INDUROP_SOAK_TIME=$(T) $(CTEST) -V -L soak

rt-proof: T = 10
rt-proof: with-tests ## nothing lost, and the maximum: schedules for T seconds of counted time each (T=10, 60) in QEMU with Debian's RT kernel
	@.ci/install-deps proof
	@tests/proof/guest.py fetch
	@INDUROP_PROOF_SECONDS=$(T) $(CTEST) -V -L proof_long

target-proof: CUTS = 100
target-proof: with-tests ## the packages in a Debian with systemd in QEMU, and CUTS losses of power (CUTS=1000 at night); as root
	@.ci/install-deps proof
	@tests/proof/guest.py fetch
	@INDUROP_CUTS=$(CUTS) $(CTEST) -V -j 1 -L target

fuzz: T = 10m
fuzz: with-tests ## all fuzz targets for T each (T=90s, 10m, 2h); findings stay in build/tests/fuzz
	@cmake --build --preset release -j $(JOBS) --target fuzz_targets
	@tests/fuzz/fuzz.sh build $(T) $(JOBS)

check-deps:
	@missing=$$(.ci/install-deps --list build); if [ -n "$$missing" ]; then \
	  echo "missing Debian packages:$$missing"; echo "run: make install-deps"; exit 1; fi

install-deps: ## install the Debian packages of .ci/packages.txt that are missing
	@.ci/install-deps

sanitize: asan-ubsan tsan ## tests under ASan + UBSan, then under TSan

# Reports go to files: otherwise those of processes whose output a test does not check would be lost. A file may also hold
# only the warning that ASan does not know all of swapcontext, which is no finding.
asan-ubsan tsan: reports = build-$(@:-ubsan=)/reports
asan-ubsan tsan:
	@.ci/install-deps build test
	@cmake --preset $@ --log-level=WARNING >/dev/null
	@cmake --build --preset $@ -j $(JOBS)
	@rm -rf $(reports) && mkdir -m 1777 $(reports)
	@ctest --preset $@ -j $(JOBS); code=$$?; \
	  found=$$(grep -lsE 'ERROR: |runtime error: |WARNING: ThreadSanitizer' $(reports)/*) && cat $$found && code=1; exit $$code

tidy: with-tests ## clang-tidy over all sources
	@$(CTEST) -L tidy

format: ## clang-format all C++ files in place
	@python3 tests/lint/check_format.py . --fix

bench: ## compare with cyclictest, raw globals and futexes; prints ratios
	@.ci/install-deps build bench
	@cmake --preset bench --log-level=WARNING >/dev/null
	@cmake --build --preset bench -j $(JOBS)
	@cmake --build --preset bench --target run-bench

bench-peers: ## compare with cyclictest, LinuxCNC, roscpp, iceoryx, Cyclone DDS, Fast DDS; wants an idle machine
	@.ci/install-deps build bench peers
	@cmake --preset bench --log-level=WARNING >/dev/null
	@cmake --build --preset bench -j $(JOBS)
	@cmake --build --preset bench --target run-peers

docs: ## API pages of the public headers, in build/docs/html/index.html
	@.ci/install-deps docs
	@mkdir -p build
	@INDUROP_VERSION=$$(sed -n 's/^project(InduRoP VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt) doxygen docs/Doxyfile

ifeq ($(ARCH),arm64)
deb:
	@JOBS=$(JOBS) ARCH=arm64 nice cmake/packaging/make_deb.sh build/deb-arm64
else
deb: ## Debian packages of the committed tree in build/deb, checked by lintian; ARCH=arm64: cross-compiled, in build/deb-arm64, as root
	@.ci/install-deps build deb
	@cmake --preset release --log-level=WARNING $(without_tests) >/dev/null
	@for target in indurop_page indurop_opcua; do cmake --build --preset release -j $(JOBS) --target $$target || true; done
	@JOBS=$(JOBS) nice cmake/packaging/make_deb.sh
endif

apt: ## a signed apt repository of these packages in build/apt
	@.ci/install-deps deb
	@cmake/packaging/make_apt.sh

container: ## an image of a board for podman and docker, from the package in build/deb, in build/container
	@.ci/install-deps container
	@cmake/packaging/make_container.sh

container-proof: ## make this image, deploy a plant into a container of it, kill it and replace it
	@.ci/install-deps container
	@tests/integration/packaging/prove_container.sh build/deb build/container-proof

deb-proof: ## build the packages again elsewhere and compare; install, upgrade, remove, purge them in a new Debian (as root)
	@.ci/install-deps deb deb-proof
	@tests/integration/packaging/compare_builds.sh build/deb build/deb-again
	@tests/integration/packaging/prove_packages.sh build/deb build/deb-proof

arm64: ## programs, examples and unit tests for ARM64 in build-arm64, cross-compiled in a Debian of its own; as root, on x86-64
	@cmake/arm64_root.sh sh -c 'cmake --preset arm64 --log-level=WARNING >/dev/null && cmake --build --preset arm64 -j $(JOBS)'

arm64-test: all arm64 ## these unit tests, the chapter's example, a plant of both architectures: by qemu-user and in QEMU with Debian's kernel for ARM64
	@JOBS=$(JOBS) cmake/arm64_root.sh tests/arm64/arm64_test.py build-arm64
	@tests/arm64/plant_test.py build build-arm64

install: all ## install to PREFIX (default /usr/local)
	@cmake --install build --prefix "$(PREFIX)" --strip

uninstall: ## remove what the last `make install` wrote
	@test -f build/install_manifest.txt || { echo "make: nothing was installed from this folder"; exit 1; }
	@xargs -d '\n' rm -fv <build/install_manifest.txt | wc -l | sed 's/$$/ files removed/'
	@sed 's|/[^/]*$$||' build/install_manifest.txt | sort -ur | xargs -d '\n' rmdir --ignore-fail-on-non-empty -p 2>/dev/null || true
	@rm build/install_manifest.txt

clean: ## remove all build directories; the Debian of make arm64 stays (build-arm64-root)
	@rm -rf build build-dev build-asan build-tsan build-bench build-arm64

help: ## this list
	@grep -hE '^[a-z][a-z0-9 -]*:.*## ' Makefile | sed -E 's/^([a-z0-9-]+)[^#]*## /\1\t/' | expand -t 16

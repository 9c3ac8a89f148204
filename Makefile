# The commands of the project; `make help` lists them. The work itself is done by CMake presets and the scripts of tools/.
.DEFAULT_GOAL := help
.PHONY: help demo build python mpi test verify bench gallery book docs manual package portable wheel format lint clean

help:    ## this list
	@awk -F ':.*## ' '/^[a-z]+: .*## / { printf "  make %-8s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))

demo: build ## install what is missing, build, run SDNV100, print its tables, leave out/sdnv100/report.html
	@tools/demo

build:   ## the program alone: build/release/carom
	@tools/setup build
	@tools/build release carom

python:  ## the Python module: build/release/python/carom, for PYTHONPATH (docs/python.md)
	@tools/setup build python
	@tools/build release carom_package

mpi:     ## the program on several processes, in the making: builds build/release/carom-mpi, runs SDNV100 on two (docs/distributed.md)
	@tools/setup build mpi
	@tools/build release carom-mpi
	@tools/on_ranks 2 build/release/carom-mpi run cases/sdnv100/current.toml --out out/sdnv100_on_ranks

test:    ## the same set-up, then all tests through ctest
	@tools/setup build python test
	@tools/build release all
	@ctest --preset release -j "$$(nproc)"

verify: build ## long verification cases, resumable, writes docs/verification.md; then 300 impacts, 600 of random shapes, 60 towers, 100 impacts seen otherwise, halves and quarters of 60, edges and curves with defaults, a soak, decks of CalculiX, data races, lines that tests run
	@tools/verify
	@/usr/bin/python3 tests/verification/impact_trial.py build/release/carom --jobs "$$(nproc)"
	@tools/setup python
	@/usr/bin/python3 tests/verification/shape_trial.py build/release/carom --jobs "$$(nproc)"
	@/usr/bin/python3 tests/verification/tower_trial.py build/release/carom --jobs "$$(nproc)"
	@/usr/bin/python3 tests/verification/galilean_trial.py build/release/carom
	@/usr/bin/python3 tests/verification/symmetry_trial.py build/release/carom
	@/usr/bin/python3 tests/verification/edges_and_curves.py build/release/carom
	@/usr/bin/python3 tools/soak.py build/release/carom
	@tools/setup verify
	@/usr/bin/python3 tests/verification/calculix_decks.py build/release/carom
	@tools/setup test
	@tools/thread_check
	@tools/coverage.py

bench:   ## measures kernels, steps, growth, implicit runs, peers: writes docs/performance.md (half an hour)
	@tools/setup build bench
	@tools/bench

gallery: build ## runs what people do with Carom, leaves its pictures in out/gallery/index.html, and in docs/gallery.md
	@tools/setup test
	@/usr/bin/python3 tools/gallery.py build/release/carom --docs

book: build ## runs every case, leaves the verification book, out/book/verification.html and .pdf
	@tools/setup test book
	@/usr/bin/python3 tools/book.py build/release/carom

docs:    ## writes the pages of docs/ that follow from tables of the code: case format, laws, quantities, schemes and enforcements, decks
	@tools/setup build python test
	@tools/build release casefile_tests
	@tools/build release translate_tests
	@tools/docs.py build/release/tests/casefile_tests build/release/tests/translate_tests

manual:  ## the pages of docs/ as a site that can be searched without a network: out/manual/index.html
	@tools/setup manual
	@tools/manual.py

package: ## the Debian packages, build/release/*.deb: the program, its Python module and the manual, looked at by lintian
	@tools/setup build python package manual
	@tools/package

portable: ## a folder with the program and all its libraries, for other Linux systems: build/portable/*.tar.gz (docs/install.md)
	@tools/setup build portable
	@tools/portable

wheel:   ## the Python module with all its libraries, for pip: build/wheel/*.whl (docs/install.md)
	@tools/setup build python portable
	@tools/wheel

format:  ## rewrite all sources as .clang-format says
	@tools/setup ci
	@tools/sources | xargs clang-format-14 -i

lint:    ## formatting, layers, sizes, words, links, names in pages, clang-tidy, ESLint
	@tools/setup build python test ci
	@tools/lint

clean:   ## remove build/ and out/
	@rm -rf build out

# The commands that a stranger needs; scripts/ does the work, CMakePresets.json says how things are built.
BUDGET ?= short
PREFIX ?= /usr/local
ROOM ?=

.PHONY: help setup build run test soak bench docs tidy format install clean

help:
	@echo "make run      build, mill the main example into out/bowl and, on a terminal, show it live"
	@echo "make build    build/release/tribo and build/wasm/*.wasm"
	@echo "make test     every test: g++, clang, WebAssembly"
	@echo "make soak     sanitizers and fuzzing, BUDGET=short or long"
	@echo "make bench    measure into build/bench.json"
	@echo "make docs     the API reference of the installed headers into build/docs/html"
	@echo "make install  PREFIX=$(PREFIX), DESTDIR as usual"
	@echo "make tidy     clang-tidy, ROOM=field for one room"
	@echo "make format   clang-format and Prettier in place"
	@echo "make setup    install what packages.txt names for build and test"
	@echo "make clean    remove build/ and out/"

setup:
	@scripts/setup.sh run test docs

build:
	@scripts/setup.sh run
	@scripts/build.sh

# The page of the live view needs Node.js: fetched only where somebody is there to see it.
run:
	@scripts/setup.sh run $$([ -t 0 ] && [ -t 1 ] && echo page)
	@scripts/build.sh
	@scripts/run.sh

test:
	@scripts/setup.sh run test docs
	@scripts/test.sh

soak:
	@scripts/setup.sh run test
	@scripts/soak.sh $(BUDGET)

bench:
	@scripts/setup.sh run bench
	@scripts/bench.sh

docs:
	@scripts/setup.sh docs
	@scripts/docs.sh

tidy:
	@scripts/tidy.sh $(ROOM)

format:
	@scripts/check_format.sh --fix

install: build
	@cmake --install build/release --prefix $(PREFIX)

clean:
	@rm -rf build out

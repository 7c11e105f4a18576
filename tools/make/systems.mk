# `make test-systems`: the two commands of the README from bare roots of other systems (tests/systems/). As root.

SYSTEMS ?= debian:bookworm debian:trixie ubuntu:noble
COMPILERS ?= g++ clang++

.PHONY: test-systems
test-systems:  ## `make run` and `make test` from bare Debian and Ubuntu, as root; SYSTEMS="debian:trixie ..." COMPILERS="g++ clang++"
	$(needs) systems
	@tests/systems/systems.py $(SYSTEMS) --compilers $(COMPILERS) --folder $(BUILD)/systems --document tests/README.md

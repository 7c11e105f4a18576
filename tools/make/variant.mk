# What is compiled with which flags, and into which folder: one folder per compiler, architecture and sanitizer, so that
# variants live side by side. What was built with other flags than those of now is forgotten (stale.mk).

BUILD ?= build
variant := $(notdir $(lastword $(filter-out -%,$(CXX))))-$(ARCH)$(if $(LANES),-lanes$(LANES))$(if $(SAN),-$(if $(filter memory,$(SAN)),memory,san))
build := $(BUILD)/$(variant)

# Packages of a system live where its compiler looks, with two exceptions: Eigen has a folder of its own, brew a prefix.
prefixes := $(wildcard /opt/homebrew /home/linuxbrew/.linuxbrew)
system_includes := -isystem /usr/include/eigen3 $(foreach p,$(prefixes),-isystem $p/include -isystem $p/include/eigen3)
libraries := $(foreach p,$(prefixes),-L$p/lib) -lfmt -lxxhash
bench_libraries := -lbenchmark -lpthread

# SAN=1: stop at the first finding of the address or the undefined-behaviour sanitizer.
# Null, alignment and object-size checks are left out: the address sanitizer and the aligned loads of the machine find the
# same faults, and with them a test file takes 128 s to compile instead of 50. So is use after scope, which no array of
# the kernel can suffer, and -Og is used: agreement_walls_test.cpp compiles in 36 s and runs in 1.9 s, at -O1 with use
# after scope in 111 s and 1.9 s, at -O0 in 32 s and 28 s.
sanitizers := $(if $(SAN),-fsanitize=address -fsanitize=undefined -fno-sanitize=null -fno-sanitize=alignment \
  -fno-sanitize=object-size -fno-sanitize-address-use-after-scope -fno-sanitize-recover=all)
# SAN=memory, with CXX=clang++: stop where memory is used that was never written. All that writes must be compiled so: fmt
# as headers, and a standard library of our own making (instrumented_library.sh; INSTRUMENTED: one that is there already).
INSTRUMENTED ?= $(BUILD)/instrumented
ifeq ($(SAN),memory)
sanitizers := -fsanitize=memory -fno-sanitize-recover=all
library_headers := -DFMT_HEADER_ONLY -nostdinc++ -isystem $(INSTRUMENTED)/include/c++/v1
libraries := -nostdlib++ $(INSTRUMENTED)/lib/libc++.a -lpthread -lxxhash
endif
# With AVX-512 gcc 12 takes the undefined registers in its own headers for uninitialised values wherever Eigen uses them; for
# real ones `make check` has clang's memory sanitizer.
undefined_registers := $(if $(findstring clang,$(CXX)),,-Wno-maybe-uninitialized)
# clang takes the & and | of scalar lanes, which must not branch, for mistyped && and ||.
unbranched := $(if $(findstring clang,$(CXX)),-Wno-bitwise-instead-of-logical)
warnings := -Wall -Wextra -Wconversion -Wshadow $(undefined_registers) $(unbranched) $(if $(SAN),-Werror)
# gcc looks for garbage of its own from 400 MB on instead of 100 MB: files that instantiate the kernel, which take 500 MB
# then and 400 MB else, compile in a sixth less time.
collect_later := $(if $(findstring clang,$(CXX)),,--param ggc-min-heapsize=400000)
common := -std=c++20 $(warnings) -I$(build) -I. $(library_headers) $(system_includes) $(if $(SAN),-g1) $(sanitizers) $(collect_later)

# The same bits everywhere (kernel/README.md): no contraction to fma behind our back, a hardware root instead of one
# that sets errno, and divisions that the compiler may move because no floating-point trap is ever looked at.
# Never -ffast-math: it would reorder sums and throw away the tests for non-finite states.
#
# ARCH is a value of -march, or `scalar`: this machine's instructions, one lane. LANES=1, 2, 4 or 8 computes on so many
# doubles at once instead of as many as a register holds; 8 on a machine with AVX2 only are pairs of registers, and gcc
# would remark for each function that AVX-512 passes such values differently.
machine := $(shell uname -m)
arch_of = $(if $(filter scalar lanes%,$(1)),-march=native,$(if $(filter aarch64,$(1)),-march=armv8-a,-march=$(1)))
lanes_of = $(if $(1),-DFIXDEM_LANES=$(1) $(if $(filter 8,$(1)),-Wno-psabi))
math_rules := -ffp-contract=off -fno-math-errno -fno-trapping-math
kernel_math := $(call arch_of,$(ARCH)) $(call lanes_of,$(if $(filter scalar,$(ARCH)),1,$(LANES))) $(math_rules)

ifeq ($(ARCH)$(filter aarch64 arm64,$(machine)),aarch64)
$(error fixdem: ARCH=aarch64 on this $(machine) machine: programs of cases would need libraries for aarch64; `make identical` \
  compiles the scenes of tests/identical for it and runs them under emulation)
endif
# Other values are passed on when the compiler knows them (ARCH=znver4).
archs := native scalar x86-64-v4 x86-64-v3 x86-64
ifeq ($(filter $(archs),$(ARCH)),)
arch_meant := $(firstword $(if $(filter avx512% avx-512% AVX512% AVX-512%,$(ARCH)),x86-64-v4) $(if $(filter avx% AVX% fma% FMA% v3,$(ARCH)),x86-64-v3) \
  $(if $(filter sse% SSE% x64 amd64 x86_64 x86,$(ARCH)),x86-64) $(if $(filter neon NEON arm% ARM%,$(ARCH)),native) $(if $(filter lanes%,$(ARCH)),scalar) \
  $(shell printf '%s\n' $(archs) | awk -v word='$(ARCH)' -f tools/make/nearest.awk))
ifeq ($(shell ! command -v $(firstword $(CXX)) >/dev/null || $(CXX) -march=$(ARCH) -fsyntax-only -x c++ /dev/null 2>/dev/null || echo unknown),unknown)
$(call refuse,ARCH=$(ARCH): the compiler knows no such instruction set; allowed: $(archs)$(comma) and whatever -march of $(CXX) takes$(if \
  $(arch_meant),; did you mean $(arch_meant)?))
endif
endif

program_flags := $(common) $(if $(SAN),-Og,-O3) $(kernel_math)
# -O1 takes a quarter longer to compile, -O2 two thirds; results are the same bytes.
test_flags := $(common) -Og $(kernel_math)
# Those that run for longer than they compile: agreement_test.cpp takes 12 and 33 s at -Og, 17 and 16 s at -O1.
optimised_tests := agreement_test agreement_mixed_test mixed_precision_test
tool_flags := $(common) -Og $(kernel_math)  # nothing hot in there; the run library includes headers of the kernel
link_flags := $(sanitizers)

# The final state of every shipped case is pinned in both precisions (tests/golden_test.cpp). `make test` builds the programs
# of each case's own and of these, which have each kind of contact, because a program takes 5 s to compile; `make golden` and
# `make check` build all, as PRECISION/CASE.
golden_some := $(addprefix mixed/,collide_pair oblique_wall pipe_bed plug_u24)

# What the program of a case and the tests are told: the case, and where things lie.
program_defines = -DFIXDEM_CASE=$(1) -DFIXDEM_CASE_HEADER='"cases/$(2).hpp"'
test_defines := -DFIXDEM_CASEGEN='"$(abspath $(build)/casegen)"' -DFIXDEM_CASES_DIR='"$(abspath cases)"' \
                -DFIXDEM_SCRATCH='"$(abspath $(build)/scratch)"' -DFIXDEM_BIN_DIR='"$(abspath $(build)/bin)"' \
                -DFIXDEM_GOLDEN='"$(abspath tests/golden/states.txt)"' \
                -DFIXDEM_GOLDEN_SCENES='"$(abspath tests/golden/scenes.txt)"' -DFIXDEM_GOLDEN_SOME='"$(golden_some)"' \
                -DFIXDEM_CORPUS='"$(abspath tests/corpus)"'

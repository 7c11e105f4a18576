# What is compiled with which flags, and into which folder: one folder per compiler, architecture and sanitizer, so that
# variants live side by side. Everything built depends on this file.

BUILD ?= build
variant := $(notdir $(lastword $(CXX)))-$(ARCH)$(if $(SAN),-san)
build := $(BUILD)/$(variant)

# Packages of a system live where its compiler looks, with two exceptions: Eigen has a folder of its own, brew a prefix.
prefixes := $(wildcard /opt/homebrew /home/linuxbrew/.linuxbrew)
system_includes := -isystem /usr/include/eigen3 $(foreach p,$(prefixes),-isystem $p/include -isystem $p/include/eigen3)
libraries := $(foreach p,$(prefixes),-L$p/lib) -lfmt -lxxhash

# SAN=1: stop at the first finding of the address or the undefined-behaviour sanitizer.
# Null, alignment and object-size checks are left out: the address sanitizer and the aligned loads of the machine find the
# same faults, and with them a test file takes 128 s to compile instead of 50.
sanitizers := $(if $(SAN),-fsanitize=address -fsanitize=undefined -fno-sanitize=null -fno-sanitize=alignment \
  -fno-sanitize=object-size -fno-sanitize-recover=all)
warnings := -Wall -Wextra -Wconversion -Wshadow
common := -std=c++20 $(warnings) -I$(build) -I. $(system_includes) $(if $(SAN),-g) $(sanitizers)

# The same bits everywhere (kernel/README.md): no contraction to fma behind our back, a hardware root instead of one
# that sets errno, and divisions that the compiler may move because no floating-point trap is ever looked at.
# Never -ffast-math: it would reorder sums and throw away the tests for non-finite states.
kernel_math := -march=$(ARCH) -ffp-contract=off -fno-math-errno -fno-trapping-math

program_flags := $(common) $(if $(SAN),-O1,-O3) $(kernel_math)
test_flags := $(common) $(if $(SAN),-O1,-O2) $(kernel_math)
tool_flags := $(common) -O1 $(kernel_math)  # nothing hot in there; the run library includes headers of the kernel
link_flags := $(sanitizers)

# What the program of a case and the tests are told: the case, and where things lie.
program_defines = -DFIXDEM_CASE=$(1) -DFIXDEM_CASE_HEADER='"cases/$(2).hpp"'
test_defines := -DFIXDEM_CASEGEN='"$(abspath $(build)/casegen)"' -DFIXDEM_CASES_DIR='"$(abspath cases)"' \
                -DFIXDEM_SCRATCH='"$(abspath $(build)/scratch)"' -DFIXDEM_BIN_DIR='"$(abspath $(build)/bin)"'

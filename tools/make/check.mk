# `make check`: what compilers, analysers and sanitizers find in code and tests, and all pinned states.

checked := $(build)/checked
# Not believed: cppcheck 2.10 cannot read generic lambdas with template parameters (syntaxError) and takes
# conditional operators of the kernel for broken (internalAstError).
cppcheck_suppressed := missingInclude missingIncludeSystem syntaxError internalAstError
cppcheck_options := --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
  --quiet -I. -I$(build) $(cppcheck_suppressed:%=--suppress=%)

$(INSTRUMENTED)/lib/libc++.a: tools/make/instrumented_library.sh
	$(call say,build the standard library of clang for the memory sanitizer)
	$(quiet)$< $(INSTRUMENTED)

$(checked)/cppcheck.ok: $(wildcard tools/casegen/*.?pp tools/run/*.?pp kernel/*.hpp) tools/make/check.mk | $(build)/cases/plug_u24.hpp
	@mkdir -p $(@D)
	$(call say,cppcheck tools/casegen tools/run)
	$(quiet)cppcheck $(cppcheck_options) tools/casegen tools/run
	@touch $@

# valgrind knows AVX2 at most.
.PHONY: check-valgrind
check-valgrind:
	$(files) build-program CASE=settle
	@valgrind --quiet --error-exitcode=9 $(build)/bin/settle --out $(build)/scratch/valgrind --replace --quiet --duration 4e-4

.PHONY: check
check:  ## formatting, clang-tidy, cppcheck, all pinned states, valgrind, and the tests under sanitizers (address, behaviour, memory)
	$(needs) run test check
	@clang-format --dry-run -Werror $(sources)
	$(files) build-tidy $(checked)/cppcheck.ok
	$(files) build-golden
	@FIXDEM_GOLDEN_ALL='$(golden_all)' $(build)/tests --test-case='golden*' --no-intro
	@$(MAKE) check-valgrind $(if $(filter x86_64 amd64,$(machine)),ARCH=x86-64-v3)
	@$(MAKE) test SAN=1
	@$(MAKE) test SAN=memory CXX=clang++

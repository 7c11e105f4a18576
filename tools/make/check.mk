# What make check looks for beside the tests under sanitizers: reading uninitialised memory in the scenes of make identical
# (clang's sanitizer) and in a whole program (valgrind), and what cppcheck finds.

checked := $(build)/checked
# Not believed: cppcheck 2.10 cannot read generic lambdas with template parameters (syntaxError) and takes
# conditional operators of the kernel for broken (internalAstError).
cppcheck_suppressed := missingInclude missingIncludeSystem syntaxError internalAstError
cppcheck_options := --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
  --quiet -I. -I$(build) $(cppcheck_suppressed:%=--suppress=%)

.PHONY: build-checked
build-checked: $(checked)/cppcheck.ok $(checked)/memory.ok $(INSTRUMENTED)/lib/libc++.a

$(INSTRUMENTED)/lib/libc++.a: tools/make/instrumented_library.sh
	$(call say,build the standard library of clang for the memory sanitizer)
	$(quiet)$< $(INSTRUMENTED)

$(checked)/cppcheck.ok: $(wildcard tools/casegen/*.?pp tools/run/*.?pp kernel/*.hpp) tools/make/check.mk | $(build)/cases/plug_u24.hpp
	@mkdir -p $(@D)
	$(call say,cppcheck tools/casegen tools/run)
	$(quiet)cppcheck $(cppcheck_options) tools/casegen tools/run
	@touch $@

# The scenes of make identical, compiled by another compiler, too.
$(checked)/memory: tests/identical/main.cpp $(wildcard kernel/*.hpp) tests/identical/scenes.hpp tools/make/check.mk \
  | $(build)/cases/plug_u24.hpp $(build)/cases/settle.hpp
	@mkdir -p $(@D)
	$(call say,compile $< for the memory sanitizer)
	$(quiet)clang++ -std=c++20 -I. -I$(build) $(kernel_math) -O1 -g1 -fsanitize=memory -fno-sanitize-recover=all $< -o $@

$(checked)/memory.ok: $(checked)/memory tests/golden/scenes.txt
	$(call say,small scenes under the memory sanitizer)
	$(quiet)$< | diff - tests/golden/scenes.txt
	@touch $@

# valgrind knows AVX2 at most.
.PHONY: check-valgrind
check-valgrind:
	$(files) build-program CASE=settle
	@valgrind --quiet --error-exitcode=9 $(build)/bin/settle --out $(build)/scratch/valgrind --quiet --duration 4e-4

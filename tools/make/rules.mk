# How each file is made: casegen, the run library, a case's header and program, the tests; and when a run is out of date.

case_names := $(sort $(basename $(notdir $(wildcard cases/*.toml))))
plug_cases := fill_1000 fill_500 plug_u24 plug_u24_n500 plug_u17 plug_u17_d3 plug_u24_d3
sources := $(wildcard kernel/*.hpp tools/*/*.hpp tools/*/*.cpp tests/*.hpp tests/*.cpp tests/*/*.hpp tests/*/*.cpp bench/*.hpp bench/*.cpp)
# A short line for each file; the whole command with V=1.
quiet := $(if $(V),,@)
say = @echo '  $(1)' >&2
# The end of a compiler's command. It writes under other names first, so that neither two makes at once nor one that is killed
# leave half a file; $(1): its notes on what the file was made of (forget_stale.sh).
kept = -MMD -MP -MT $@ -MF $(1).$$$$ -o $@.$$$$ && mv -f $(1).$$$$ $(1) && mv -f $@.$$$$ $@ || { rm -f $(1).$$$$ $@.$$$$; exit 1; }
linked = -o $@.$$$$ && mv -f $@.$$$$ $@ || { rm -f $@.$$$$; exit 1; }
object = -c $< $(call kept,$(@:.o=.d))

# CASE is a name in cases/ or a path. What is built for a file elsewhere, and its results, have folders of their own
# (name_apart.sh), so that two files never share one.
case_file := $(if $(filter %.toml,$(CASE)),$(CASE),cases/$(CASE).toml)
case_name := $(basename $(notdir $(case_file)))
case_folder := $(dir $(case_file))
run_name := $(if $(findstring /,$(CASE))$(filter %.toml,$(CASE)),$(shell tools/make/name_apart.sh $(case_file) cases),$(CASE))
is_shipped := $(filter $(case_name),$(run_name))
case_build := $(if $(is_shipped),$(build),$(build)/elsewhere/$(shell tools/make/name_apart.sh $(case_folder)))
case_header := $(case_build)/cases/$(case_name).hpp
case_program := $(case_build)/bin/$(case_name)
case_bench := $(case_build)/bench-case/$(case_name)
results = out/$(1)$(if $(SEED),-seed$(SEED))
usual := $(call results,$(run_name))
out := $(or $(OUT),$(usual))

.PHONY: print-program
print-program:
	@echo $(case_program)

.PHONY: build-program build-cases build-tests build-golden build-bench build-peers build-tidy
build-program: $(case_program)
build-cases: $(case_names:%=$(build)/bin/%)
mixed_cases := $(basename $(notdir $(shell grep -l '^precision *= *"mixed"' cases/*.toml)))
golden_all := $(addprefix mixed/,$(filter-out $(mixed_cases),$(case_names))) $(addprefix double/,$(mixed_cases))
precision_programs := $(golden_all:%=$(build)/precision/%)
build-tests: build-cases $(golden_some:%=$(build)/precision/%) $(build)/tests
build-golden: build-cases $(precision_programs) $(build)/tests
build-bench: $(build)/bench

# casegen, and the library that all programs share.
objects = $(patsubst %.cpp,$(build)/objects/%.o,$(1))
casegen := $(build)/casegen
casegen_objects := $(call objects,$(wildcard tools/casegen/*.cpp))
run_objects := $(call objects,$(filter-out tools/run/main.cpp,$(wildcard tools/run/*.cpp)))

$(build)/objects/tools/%.o: tools/%.cpp
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(CXX) $(tool_flags) $(object)

$(casegen): $(casegen_objects)
	$(call say,link $@)
	$(quiet)$(CXX) $(link_flags) $^ $(libraries) $(linked)

# Which kernel a program has, for its checkpoints: they are continued by the same kernel only.
kernel_checksum = -DFIXDEM_KERNEL='"'$$(cat kernel/*.hpp | cksum | tr ' ' -)'"'

# A case: its header, then the one program that is compiled for it. $(1): folder of the build, $(2): folder of the file; $(3):
# `always`, and casegen reads the file, and those it starts from, each time, but for derived files, whose time stamps are our
# own. It leaves a header alone when nothing in it changes, so that its
# program is not compiled again. The mark `.checked` holds what it said, and is left alone when it says the same. The advice on
# the time step is shown for CASE, and for others when there is a warning.
define case_rules
$(1)/cases/%.checked: $(2)%.toml $(casegen) $(3)
	@mkdir -p $$(@D)
	@said="$$$$($(casegen) $$< --output $$(@:.checked=.hpp) --source-label $$< 2>&1)" || { echo "$$$$said" >&2; exit 3; }; \
	if [ ! -e $$@ ] || [ "$$$$said" != "$$$$(cat $$@)" ]; then \
	  if [ $$* = $(case_name) ] || [[ "$$$$said" == *warning* ]]; then echo "$$$$said" >&2; fi; \
	  echo "$$$$said" >$$@.$$$$$$$$; mv -f $$@.$$$$$$$$ $$@; fi

$(1)/cases/%.hpp: $(1)/cases/%.checked
	@[ -e $$@ ] || $(casegen) $(2)$$*.toml --output $$@ --source-label $(2)$$*.toml

$(1)/bin/%: $(1)/cases/%.hpp tools/run/main.cpp $(run_objects)
	@mkdir -p $$(@D)
	$$(call say,compile the program of $(2)$$*.toml)
	$(quiet)$$(CXX) -I$(1) $(program_flags) $(link_flags) $$(kernel_checksum) \
	  $$(call program_defines,$$$$($(casegen) --name $(2)$$*.toml),$$*) tools/run/main.cpp $(run_objects) $(libraries) $$(call kept,$(1)/cases/$$*.d)

$(1)/bench-case/%: $(1)/cases/%.hpp bench/one_case.cpp $(run_objects)
	@mkdir -p $$(@D)
	$$(call say,compile the benchmark of $(2)$$*.toml)
	$(quiet)$$(CXX) -I$(1) $(program_flags) $(link_flags) \
	  $$(call program_defines,$$$$($(casegen) --name $(2)$$*.toml),$$*) bench/one_case.cpp $(run_objects) $(libraries) \
	  $(bench_libraries) $$(call kept,$(1)/cases/$$*.bench.d)
endef
.PHONY: always
always:
$(eval $(call case_rules,$(build),cases/,always))
$(if $(is_shipped),,$(eval $(call case_rules,$(case_build),$(case_folder),always)))

# The program of a shipped case in another precision: build/<variant>/precision/PRECISION/CASE.
$(precision_programs): $(build)/precision/%: tools/run/main.cpp $(run_objects) | $(case_names:%=$(build)/cases/%.hpp)
	@mkdir -p $(@D)
	$(call say,compile the program of $*)
	$(quiet)$(CXX) $(program_flags) $(link_flags) $(kernel_checksum) -DFIXDEM_PRECISION=$(patsubst %/,%,$(dir $*))_precision \
	  $(call program_defines,$$($(casegen) --name cases/$(@F).toml),$(@F)) tools/run/main.cpp $(run_objects) $(libraries) $(call kept,$@.d)

%.toml:
	@echo "fixdem: no case file '$@'; in cases/ there are: $(case_names)" >&2; exit 3

# Cases of tests/kill_test.py, in its long form.
soak_cases := settle settle_mixed collide_pair oblique_wall drag_single pipe_bed plug_u24_n500

# Tests: one program out of every tests/*.cpp; the headers of all cases come first because any test may use any case.
# Headers of libraries that many tests include are compiled once (tests/precompiled.hpp); every test still includes what
# it needs.
# The memory sanitizer has an operator new of its own, and so no allocations can be counted.
test_objects := $(call objects,$(filter-out $(if $(filter memory,$(SAN)),tests/no_heap_test.cpp),$(wildcard tests/*.cpp tests/reference/*.cpp tests/fuzz/*_target.cpp)))
optimised_objects := $(optimised_tests:%=$(build)/objects/tests/%.o)
precompiled := $(build)/precompiled/tests.hpp
test_include = $(if $(filter $(optimised_objects) %/main.o,$@),,-include $(precompiled))
$(precompiled).gch: tests/precompiled.hpp
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)grep -v '^#pragma once' $< > $(precompiled).$$$$; mv -f $(precompiled).$$$$ $(precompiled)
	$(quiet)$(CXX) $(test_flags) $(test_defines) -x c++-header -c $(precompiled) $(linked)

$(optimised_objects): test_flags := $(test_flags) -O1
$(build)/objects/tests/%.o: tests/%.cpp $(precompiled).gch | $(case_names:%=$(build)/cases/%.hpp)
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(CXX) $(test_flags) $(test_defines) $(test_include) $(object)

$(build)/tests: $(test_objects) $(run_objects) $(filter-out %/main.o,$(casegen_objects)) $(call objects,tools/stability/tangent.cpp)
	@mkdir -p $(build)/scratch
	$(call say,link $@)
	$(quiet)$(CXX) $(link_flags) $^ $(libraries) $(linked)

# The scenes that must be identical, once for each instruction set: `native` as programs are compiled, the others at a
# lower level of optimisation, which must not matter either; then for this machine at other levels, by clang, too.
# `make test` compares this machine's with the same pinned hashes (tests/lanes_test.cpp), `make identical` all of them.
# They are never built with sanitizers.
is_x86 := $(filter x86_64 amd64,$(machine))
optimised := O1 O2 clang-O1 clang-O2 clang-O3
identical_all := native scalar lanes2 $(if $(is_x86),x86-64 x86-64-v3 x86-64-v4 $(if $(filter Linux,$(shell uname -s)),$(optimised) aarch64 cortex-m7))
cross_compiler := aarch64-linux-gnu-g++
.PHONY: build-identical
build-identical: $(identical_all:%=$(build)/identical/%)
$(identical_all:%=$(build)/identical/%): $(build)/identical/%: tests/identical/main.cpp tools/make/embedded.mk \
  | $(build)/cases/plug_u24.hpp $(build)/cases/settle.hpp
	@mkdir -p $(@D)
	$(call say,compile $< for $*)
	$(quiet)$(call variant_compiler,$*) -I$(build) $< $(call variant_link,$*,$@) $(call kept,$@.d)

# Benchmarks: compiled like the programs, because it is those that are timed. bench/one_case.cpp is compiled for a case.
bench_objects := $(call objects,$(filter-out bench/one_case.cpp,$(wildcard bench/*.cpp)))
bench_options = $(if $(FILTER),--benchmark_filter='$(FILTER)') $(if $(JSON),--benchmark_out='$(JSON)' --benchmark_out_format=json)
$(build)/objects/bench/%.o: bench/%.cpp | $(case_names:%=$(build)/cases/%.hpp)
	@mkdir -p $(@D)
	$(call say,compile $<)
	$(quiet)$(CXX) $(program_flags) $(object)

$(build)/bench: $(bench_objects) $(run_objects)
	$(call say,link $@)
	$(quiet)$(CXX) $(link_flags) $^ $(libraries) $(bench_libraries) $(linked)

# Peers: cases that tools/peers derives from pipe_bed, each with a program of its own.
peers := $(build)/peers
peer_cases := agitated bed_settle bed impacts
build-peers: $(peer_cases:%=$(peers)/bin/%)
$(peers)/derived.done: tools/peers/derived_cases.py cases/pipe_bed.toml always
	$(quiet)$< cases/pipe_bed.toml $(peers)
	@touch $@
$(peer_cases:%=$(peers)/%.toml): $(peers)/derived.done ;
$(eval $(call case_rules,$(peers),$(peers)/))

# clang-tidy: the tools, and the kernel as one case instantiates it.
tidy_sources := $(wildcard tools/casegen/*.cpp tools/run/*.cpp)
build-tidy: $(tidy_sources:%=$(build)/tidy/%.ok)
$(build)/tidy/%.ok: % .clang-tidy $(build)/cases/plug_u24.hpp
	@mkdir -p $(@D)
	$(call say,clang-tidy $<)
	$(quiet)clang-tidy --quiet $< -- $(filter-out -march=%,$(tool_flags)) $(call program_defines,plug_u24,plug_u24) \
	  2> >(grep -v ' warnings generated' >&2)
	@touch $@

# Runs. SEED goes to the case whose start is random: to CASE itself, or to the one that it starts from; results of a
# seed lie in a folder of their own. A whole run (no ARGS, begun at its beginning) into the usual folder leaves a mark beside the
# program: another case can start from the final state there while program, start and final state are those of the mark.
mark := $(case_program)$(if $(SEED),-seed$(SEED)).done
read_start = from="$$($(casegen) --start-from $(case_file))"; \
  start=$${from:+$(call results,$$(tools/make/name_apart.sh "$$from" cases))/final.fixdem}
# A second look, by another way than make's: the program must have been compiled for the text that the case file has now.
same_text = hash=$$($(casegen) --hash $(case_file)); [[ "$$($(case_program) --version)" == *"xxh64 $$hash"* ]] || \
  { echo 'fixdem: $(case_file) has changed since its program was compiled: run make again' >&2; exit 3; }
run_case = $(case_program) --out $(1) \
  $${start:+--start-state "$$start"} $(if $(SEED),$$([ -n "$$start" ] || echo --seed $(SEED))) $(ARGS)
how = $(if $(RESUME),$(if $(filter 1,$(RESUME)),--resume,--resume-from $(RESUME)))$(if $(FRESH),--fresh)$(if $(EXTEND),--extend $(EXTEND))
is_whole_run = $(if $(strip $(ARGS))$(RESUME)$(EXTEND),,$(filter $(usual),$(out)))
inputs = inputs="$$(tools/make/whole_run.sh inputs $(case_program) $${start:+"$$start"})"
# The program leaves alone the run that is there already, which another program may have made: no mark then.
leave_mark = [ -z "$$inputs" ] || tools/make/whole_run.sh leave $(mark) "$$inputs" $(usual)/final.fixdem
# For a make that runs CASE as it is, whatever this make was given.
plainly := OUT= SEED= ARGS= RESUME= FRESH= EXTEND=

# Sees to the final state of the case that CASE starts from, and of the one that that starts from, and so on.
.PHONY: start-state final-state
start-state: $(case_program)
	+@$(read_start); if [ -n "$$from" ]; then $(MAKE) final-state CASE="$$from" OUT= ARGS= RESUME= FRESH= EXTEND=; fi

final-state: start-state
	@$(read_start); $(same_text); \
	if ! tools/make/whole_run.sh holds $(mark) $(usual)/final.fixdem $(case_program) $${start:+"$$start"}; then \
	  echo "fixdem: running $(run_name) first, for its final state" >&2; \
	  $(inputs); $(call run_case,$(usual)) --fresh >&2; $(leave_mark); fi

-include $(wildcard $(build)/identical/*.d $(build)/cases/*.d $(case_build)/cases/*.d $(peers)/cases/*.d $(build)/precision/*/*.d) \
  $(shell find $(build)/objects -name '*.d' 2>/dev/null)
%.d: ;

# LAMMPS for scenes too large for one core (tools/lammps/): where its files go, and the programs that run beside it.
#
# REPEAT copies a periodic scene so many times along the pipe; RANKS is the number of MPI processes.

RANKS ?= 1
MPIRUN ?= mpirun

lammps_name = $(run_name)$(if $(REPEAT),-x$(REPEAT))
lammps_out = out/lammps/$(lammps_name)$(if $(SEED),-seed$(SEED))
lammps_build := $(case_build)/lammps
gas_beside = $(lammps_build)/gas_beside/$(lammps_name)
# The state to start from: STATE, or what the case itself starts with.
lammps_start = $(or $(START),$(lammps_out)/start)
lammps_state = $(or $(STATE),$(lammps_start)/final.fixdem)
mpi_compiler = OMPI_CXX='$(CXX)' mpicxx

lammps_files = --header $(case_header) --state '$(lammps_state)' $(if $(STATE),,--origin 'its own start') \
  $(if $(REPEAT),--repeat $(REPEAT)) --out $(lammps_out)
# Prints yes for a case with gas.
lammps_has_gas = grep -q 'has_gas = true' $(case_header) && echo yes

$(gas_beside): tools/lammps/gas_beside.cpp $(case_header) $(run_objects)
	@mkdir -p $(@D)
	$(call say,compile $< for $(lammps_name))
	$(quiet)$(mpi_compiler) -I$(case_build) $(program_flags) $(link_flags) -DLAMMPS_SMALLBIG -DOMPI_SKIP_MPICXX \
	  $(addprefix -DFIXDEM_REPEAT=,$(REPEAT)) $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name)) \
	  $< $(run_objects) $(libraries) -llammps $(call kept,$@.d)

# The kernel beside LAMMPS, for make test-lammps.
$(lammps_build)/kernel_beside/$(case_name): tests/lammps/kernel_beside.cpp $(case_header) $(run_objects)
	@mkdir -p $(@D)
	$(call say,compile $< for $(case_name))
	$(quiet)$(CXX) -I$(case_build) $(test_flags) $(link_flags) \
	  $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name)) $< $(run_objects) $(libraries) $(call kept,$@.d)

.PHONY: build-kernel-beside build-gas-beside lammps-state
build-kernel-beside: $(lammps_build)/kernel_beside/$(case_name)
build-gas-beside: $(gas_beside)

# The case's own start, before its first step, where no STATE is given.
lammps-state: $(if $(STATE),,start-state)
	+@$(if $(STATE),:,rm -rf $(lammps_start); $(read_start); $(call run_case,$(lammps_start)) --duration 0 --quiet --no-frames)

# make test-lammps: single impacts in cases of their own; some shipped ones in motion, for the time given; every case's start.
lammps_test := $(build)/lammps-test
lammps_impacts = $(build)/elsewhere/$(shell tools/make/name_apart.sh $(lammps_test))
lammps_moving := settle@0.05 pipe_bed@0.05 plug_u24@0.3

.PHONY: build-test-lammps lammps-moving-state
build-test-lammps:
	@tests/lammps/impact_cases.py cases/pipe_bed.toml $(lammps_test)
	+@for file in $(lammps_test)/*.toml; do $(MAKE) build-kernel-beside CASE=$$file 2> >(grep -v 'contact\|Rayleigh\|time step' >&2); done
	+@for case in $(lammps_moving) drag_single; do $(MAKE) build-kernel-beside CASE=$${case%@*}; done
	+@for case in plug_u24 drag_single; do $(MAKE) build-gas-beside CASE=$$case; done
	+@$(MAKE) build-gas-beside CASE=plug_u24 REPEAT=100
	+@for case in $(case_names); do $(MAKE) lammps-state CASE=$$case START=$(lammps_test)/states/$$case-start; done
	+@for case in $(lammps_moving); do $(MAKE) lammps-moving-state CASE=$${case%@*} DURATION=$${case#*@}; done

lammps-moving-state: start-state
	@rm -rf $(lammps_test)/states/$(case_name); $(read_start); $(call run_case,$(lammps_test)/states/$(case_name)) --duration $(DURATION) --quiet --no-frames

.PHONY: export-lammps
export-lammps:  ## CASE as input for LAMMPS in out/lammps/CASE, from its start or STATE=file; REPEAT=n copies along a periodic pipe
	$(needs) run export
	$(files) $(case_header) $(if $(STATE),,build-program)
	+@$(MAKE) lammps-state
	@tools/lammps/export_lammps.py $(lammps_files)

.PHONY: run-lammps
run-lammps:  ## the same, run over MPI with RANKS=n processes, the gas beside it; STEPS=n; LMP=/path/to/lmp for a case without gas
	$(needs) run export mpi $(if $(LMP),,lammps)
	+@$(MAKE) export-lammps
	+@[ -z "$$($(lammps_has_gas))" ] || { $(needs:@%=%) lammps-library; $(MAKE) $(parallel) build-gas-beside; }
	@tools/lammps/run_lammps.py $(lammps_out) --header $(case_header) $(if $(REPEAT),--repeat $(REPEAT)) --ranks $(RANKS) \
	  --mpirun '$(MPIRUN)' $(if $(STEPS),--steps $(STEPS)) $$([ -n "$$($(lammps_has_gas))" ] && echo --program $(gas_beside) || \
	  echo --program '$(or $(LMP),lmp)')

.PHONY: test-lammps
test-lammps:  ## LAMMPS beside the kernel: impacts, trajectories, gas, ranks, every case, a plug (some minutes); ONLY=part; README=1: tables
	$(needs) run test export mpi lammps lammps-library
	+@$(MAKE) build-test-lammps
	@tests/lammps/lammps_test.py --build $(build) --headers $(build) --impact-build $(lammps_impacts) --states $(lammps_test)/states \
	  --out $(lammps_test)/runs $(if $(ONLY),--only $(ONLY)) $(if $(README),--readme tools/lammps/README.md)

-include $(wildcard $(lammps_build)/*/*.d)

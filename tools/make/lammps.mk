# LAMMPS for scenes too large for one core (tools/lammps/): where its files go, and the programs that run beside it.
#
# REPEAT copies a periodic scene so many times along the pipe; RANKS is the number of MPI processes.

RANKS ?= 1
REPEAT ?=
STATE ?=
MPIRUN ?= mpirun

lammps_name = $(case_name)$(if $(REPEAT),-x$(REPEAT))
lammps_out = out/lammps/$(lammps_name)$(if $(SEED),-seed$(SEED))
lammps_build := $(case_build)/lammps
gas_beside = $(lammps_build)/gas_beside/$(lammps_name)
# The state to start from: STATE, or what the case itself starts with.
lammps_state = $(or $(STATE),$(lammps_out)/start/final.fixdem)
mpi_compiler = OMPI_CXX='$(CXX)' mpicxx

lammps_files = --header $(case_header) --state '$(lammps_state)' $(if $(STATE),,--origin 'its own start') \
  $(if $(REPEAT),--repeat $(REPEAT)) --out $(lammps_out)
# Prints yes for a case with gas.
lammps_has_gas = grep -q 'has_gas = true' $(case_header) && echo yes

$(gas_beside): tools/lammps/gas_beside.cpp $(case_header) $(run_objects) tools/make/variant.mk
	@mkdir -p $(@D)
	$(call say,compile $< for $(lammps_name))
	$(quiet)$(mpi_compiler) -MMD -MP -MF $@.d -MT $@ -I$(case_build) $(program_flags) $(link_flags) -DLAMMPS_SMALLBIG \
	  $(addprefix -DFIXDEM_REPEAT=,$(REPEAT)) $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name)) \
	  $< $(run_objects) $(libraries) -llammps -o $@

# The kernel beside LAMMPS, for make test-lammps.
$(lammps_build)/kernel_beside/$(case_name): tests/lammps/kernel_beside.cpp $(case_header) $(run_objects) tools/make/variant.mk
	@mkdir -p $(@D)
	$(call say,compile $< for $(case_name))
	$(quiet)$(CXX) -MMD -MP -MF $@.d -MT $@ -I$(case_build) $(program_flags) $(link_flags) \
	  $(call program_defines,$$($(casegen) --name $(case_file)),$(case_name)) $< $(run_objects) $(libraries) -o $@

.PHONY: build-kernel-beside build-gas-beside lammps-state
build-kernel-beside: $(lammps_build)/kernel_beside/$(case_name)
build-gas-beside: $(gas_beside)

# The case's own start, before its first step, where no STATE is given.
lammps-state: $(if $(STATE),,start-state)
	+@$(if $(STATE),:,$(read_start); $(call run_case,$(lammps_out)/start) --duration 0 --quiet --no-frames)

-include $(wildcard $(lammps_build)/*/*.d)

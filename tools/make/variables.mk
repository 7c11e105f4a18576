# Every variable that a user can give to make: its kind and what it means, for `make help`; and the refusal, before anything
# is run, of names that no target knows and of values that the shell or make would read as something else. Included first.
#
# Two lines make a variable: kind.NAME and about.NAME. Kinds: `path`, `paths` and `words` (options, several separated by spaces),
# `pattern` (a regular expression), `whole`, `number`, `flag` (1, or left out), `one-of A B ...`. Values are looked at unexpanded:
# expanding one that holds $(shell ...) would run it.

kind.CASE := path
about.CASE := a name in cases/ or the path of any .toml file
kind.OUT := path
about.OUT := folder of the results
kind.SEED := whole
about.SEED := seed of a random start; of the case that CASE starts from, if it does
kind.ARGS := words
about.ARGS := options of the program: ARGS="--duration 0.1 --no-frames"
kind.RESUME := path
about.RESUME := 1: go on with a run that was stopped; or the path of the checkpoint to go on from
kind.FRESH := flag
about.FRESH := 1: move results that lie in OUT aside, to a numbered name, and begin anew
kind.EXTEND := number
about.EXTEND := go on with a finished run for so many more seconds of simulated time
kind.CXX := words
about.CXX := compiler (g++)
kind.ARCH := path
about.ARCH := instruction set: native, scalar, x86-64-v4, x86-64-v3, x86-64
kind.LANES := one-of 1 2 4 8
about.LANES := how many doubles are computed on at once (as many as a register holds)
kind.SAN := one-of 1 memory
about.SAN := 1: address and undefined-behaviour sanitizer; memory: clang's memory sanitizer
kind.BUILD := path
about.BUILD := folder of all that is built (build)
kind.V := flag
about.V := 1: show whole commands
kind.QUICK := flag
about.QUICK := 1: a part only, to try it out (stability, frontier, validate)
kind.STEPS := whole
about.STEPS := number of steps (identical, embedded, run-lammps)
kind.TIME := whole
about.TIME := seconds to go on for (soak, fuzz)
kind.FILTER := pattern
about.FILTER := regular expression of the benchmarks to run (bench)
kind.JSON := paths
about.JSON := file of figures: to write (bench), or to read (bench-report, bench-peers)
kind.SWEEP := path
about.SWEEP := file that says what to vary (sweep)
kind.ENGINE := one-of parallel slurm
about.ENGINE := what starts the runs of a sweep
kind.HOSTS := path
about.HOSTS := list of hosts for a sweep, as GNU parallel reads it
kind.SWEEP_SSH := words
about.SWEEP_SSH := command in place of ssh, with its options (sweep)
kind.JOBS := whole
about.JOBS := runs at a time (sweep, figures, plug-table, line-table, validate)
kind.REPEAT := whole
about.REPEAT := copies of a periodic scene along its pipe (export-lammps, run-lammps)
kind.STATE := path
about.STATE := state file to start from (export-lammps, run-lammps)
kind.RANKS := whole
about.RANKS := number of MPI processes (run-lammps)
kind.LMP := path
about.LMP := the LAMMPS to use
kind.MPIRUN := words
about.MPIRUN := command that starts MPI processes (mpirun)
kind.ONLY := path
about.ONLY := one part (test-lammps)
kind.README := flag
about.README := 1: rewrite the tables in tools/lammps/README.md (test-lammps)
kind.ROW := path
about.ROW := one row of the validation: section/name
kind.SECTION := path
about.SECTION := one section of the validation
kind.KEPT := flag
about.KEPT := 1: write the page of the validation from what is kept, and run nothing
kind.FORMAT := one-of mp4 gif
about.FORMAT := of a movie
kind.SECONDS := number
about.SECONDS := length of a movie
kind.PICTURES := path
about.PICTURES := folder for pictures of the page (test-report)
kind.INSTRUMENTED := path
about.INSTRUMENTED := folder of a libc++ built with the memory sanitizer (SAN=memory)
kind.SYSTEMS := words
about.SYSTEMS := debian:SUITE or ubuntu:SUITE, several (test-systems)
kind.COMPILERS := words
about.COMPILERS := commands to try on each system (test-systems)
kind.DEBIAN_MIRROR := words
about.DEBIAN_MIRROR := URL of packages (the one that this machine's apt knows; test-systems)
kind.UBUNTU_MIRROR := words
about.UBUNTU_MIRROR := the same for Ubuntu
kind.DEBIAN_KEYRING := path
about.DEBIAN_KEYRING := file of the keys that sign packages (/usr/share/keyrings/debian-archive-keyring.gpg; test-systems)
kind.UBUNTU_KEYRING := path
about.UBUNTU_KEYRING := the same for Ubuntu
# Given by one target to another; not for users, and not in `make help`.
kind.DURATION := number
kind.START := path

variables := $(patsubst kind.%,%,$(filter kind.%,$(.VARIABLES)))
from_user = $(filter command environment,$(firstword $(origin $(1))))

empty :=
hash := \#
backslash := \$(empty)
special_in_words := ` $$ ; & | < > ( ) [ ] { } ' " $(backslash) $(hash) % * ? ! ~
special := $(special_in_words) : =
digits := 0 1 2 3 4 5 6 7 8 9
without = $(if $(1),$(call without,$(wordlist 2,99,$(1)),$(subst $(firstword $(1)),,$(2))),$(2))

# What is wrong with the value of variable $(1), in words; nothing when it is right. $(2): the characters that stand for more
# than themselves, of which the first that is there is named.
specials_of = $(firstword $(foreach c,$(2),$(if $(findstring $c,$(value $(1))),$c)))
blank_in = $(filter-out 0 1,$(words $(value $(1))))$(if $(value $(1)),$(filter-out 1,$(words _$(value $(1))_)))
rename := rename it, or give another name to it with ln -s
wrong_path = $(if $(call specials_of,$(1),$(special)),the character $(call specials_of,$(1),$(special)) cannot be in a path that make works \
  with: $(rename),$(if $(call blank_in,$(1)),a blank cannot be in a path that make works with: $(rename),$(if $(filter -%,$(value \
  $(1))),it begins with - and would be taken for an option: write ./$(value $(1)))))
wrong_words = $(if $(call specials_of,$(1),$(special_in_words)),the character $(call specials_of,$(1),$(special_in_words)) is not for \
  options: start the program itself for such$(empty),$(call wrong_lines,$(1)))
wrong_paths = $(call wrong_words,$(1))
define line_break


endef
wrong_lines = $(if $(findstring $(line_break),$(value $(1))),it has a line break)
wrong_pattern = $(if $(findstring ',$(value $(1))),the character ' is not for patterns,$(if $(findstring $$,$(subst \
  $$$$,,$(value $(1)))),write $$$$ for $$$(empty),$(call wrong_lines,$(1))))
# The digits first: what is left must be nothing at all.
wrong_whole = $(if $(call without,$(digits),$(value $(1)))$(call blank_in,$(1)),it is a whole number that is needed)
wrong_number = $(if $(filter-out _ _. _e _E _e- _E- _e+ _E+ _.e _.E _.e- _.E- _.e+ _.E+,_$(call without,$(digits),$(value $(1))))$(call \
  blank_in,$(1)),it is a number that is needed$(comma) such as 0.3)
comma := ,
wrong_flag = $(if $(filter-out 1,$(value $(1)))$(call blank_in,$(1)),write $(1)=1$(comma) or leave it out)
wrong_one-of = $(if $(filter-out $(wordlist 2,99,$(kind.$(1))),$(value $(1)))$(call blank_in,$(1)),it is one of $(wordlist 2,99,$(kind.$(1))))
wrong = $(call wrong_$(firstword $(kind.$(1))),$(1))
refuse = $(error fixdem: $(subst $(line_break), ,$(1)))
where_from = $(if $(filter environment,$(firstword $(origin $(1)))), (from the environment))

$(foreach v,$(variables),$(if $(call from_user,$v),$(if $(value $v),$(if $(call wrong,$v),$(call \
  refuse,$v=$(value $v)$(call where_from,$v): $(call wrong,$v))))))

# Names on the command line that no target knows.
strangers := $(strip $(foreach v,$(filter-out $(variables) MAKE%,$(.VARIABLES)),$(if $(filter command,$(firstword $(origin $v))),$v)))
letters := A B C D E F G H I J K L M N O P Q R S T U V W X Y Z a b c d e f g h i j k l m n o p q r s t u v w x y z _
nearest = $(if $(call without,$(letters) $(digits),$(1)),,$(shell printf '%s\n' $(filter-out DURATION START,$(variables)) | \
  awk -v word='$(1)' -f tools/make/nearest.awk))
ifneq ($(strangers),)
stranger := $(firstword $(strangers))
near := $(if $(findstring $$,$(foreach v,$(strangers),$(value $v))),,$(call nearest,$(stranger)))
$(call refuse,no target knows a variable $(stranger)$(if $(near),: did you mean $(near)?) (make help lists them))
endif

ifneq ($(word 2,$(if $(RESUME),RESUME) $(if $(FRESH),FRESH) $(if $(EXTEND),EXTEND)),)
$(call refuse,RESUME$(comma) FRESH and EXTEND exclude one another: a run that was stopped goes on$(comma) one begins anew$(comma) or one that is finished becomes longer)
endif
ifeq ($(RESUME),0)
$(call refuse,RESUME=0: write RESUME=1 or RESUME=checkpoint$(comma) or leave it out)
endif

# Names of files that go to the shell, and the path of this folder, which is compiled into the tests.
odd_names := $(wildcard cases/*.toml kernel/* tools/*/*.?pp tests/*.?pp tests/*/*.?pp bench/*.?pp)
odd := $(firstword $(foreach c,$(special),$(if $(findstring $c,$(odd_names)),$c)))
ifneq ($(odd)$(filter-out cases/%.toml kernel/% tools/% tests/% bench/%,$(odd_names)),)
$(call refuse,the name of a file holds $(or $(odd),a blank)$(comma) which make cannot work with; rename it: $(firstword $(foreach \
  f,$(odd_names),$(if $(or $(foreach c,$(special),$(findstring $c,$f)),$(filter-out cases/%.toml kernel/% tools/% tests/% bench/%,$f)),$f))))
endif
odd := $(firstword $(foreach c,' " $(backslash) $$ `,$(if $(findstring $c,$(CURDIR)),$c)))
ifneq ($(odd),)
$(call refuse,the character $(odd) is in the path of this folder$(comma) $(CURDIR)$(comma) where the compiler cannot be given it: move it elsewhere)
endif

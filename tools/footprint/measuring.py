"""What a program of this folder takes: code, memory, instructions, cycles.

Code of the step is everything that can be reached from run_steps<Simulation<Case>> in the linked program. Instructions are
those of a longer run less those of a shorter one, so that start and end of the program cancel; callgrind counts them and
gives the same number every time.
"""

import re
import subprocess
from collections import defaultdict


def output(*command):
    done = subprocess.run([str(part) for part in command], check=False, text=True, capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


class Calls:
    """Which function of a linked program goes to which others, by call or jump; and how many bytes each has."""

    def __init__(self, program):
        self.targets, self.by_pointer = defaultdict(set), set()
        caller = None
        for line in output("objdump", "-d", "--no-show-raw-insn", program).splitlines():
            if start := re.match(r"[0-9a-f]+ <(\S+)>:$", line):
                caller = start[1]
            elif jump := re.search(r"\t(call|bl|j\w+|b|b\.\w+|cbn?z|tbn?z)q? +(\S.*)$", line):
                if jump[2].startswith("*"):
                    self.by_pointer.add(caller)
                target = re.search(r"<([^>+]+)(\+0x[0-9a-f]+)?>", jump[2])
                # Within itself a function jumps; only a call of its own start is a call of itself.
                if target and (target[1] != caller or (jump[1] in ("call", "bl") and not target[2])):
                    self.targets[caller].add(target[1])
        self.size = {}
        for line in output("nm", "-S", program).splitlines():
            if symbol := re.match(r"[0-9a-f]+ ([0-9a-f]+) [tTwW] (\S+)$", line):
                self.size[symbol[2]] = int(symbol[1], 16)

    def reachable(self, first):
        found, waiting = {first}, [first]
        while waiting:
            for target in self.targets[waiting.pop()] - found:
                found.add(target)
                waiting.append(target)
        return found

    def step_of(self, case):
        """Mangled names of the functions of a case's step."""
        name = re.compile(rf"^_ZN6fixdem9footprint9run_steps.*\d{re.escape(case)}E")
        first = [symbol for symbol in self.size if name.match(symbol)]
        if len(first) != 1:
            raise RuntimeError(f"run_steps of {case}: {first}")
        return self.reachable(first[0])

    def bytes_of(self, functions):
        return sum(self.size.get(name, 0) for name in functions)


def instructions(program, *arguments):
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, *arguments]
    done = subprocess.run([str(part) for part in command], check=True, text=True, capture_output=True)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def instructions_per_particle_step(program, *arguments, particles, steps=100):
    few, many = (instructions(program, *arguments, count) for count in (steps, 2 * steps))
    return (many - few) / steps / particles


def size(program, *arguments):
    """Bytes of the simulation, and its particles."""
    total, particles = output(program, *arguments, "size").split()
    return int(total), int(particles)

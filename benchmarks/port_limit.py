"""The least time that a processor needs for the kernel's vector instructions; JSON on standard output.

port_limit.py PROGRAM ENGINE.json: PROGRAM is bench_engine, ENGINE.json its output, with the number of executions of each
instruction. The limit is the longer of two times: of all vector instructions but moves, at the measured rate of independent
multiply-adds, and of the divisions and square roots at the measured rate of independent divisions.
"""
import json
import re
import subprocess
import sys

MOVES = re.compile(r"v(mov|broadcast|pbroadcast|zero|pextr|lddqu)")


def disassembled(program):
    """(address, function, mnemonic) of the program's instructions."""
    text = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", program], check=True, capture_output=True,
                          text=True).stdout
    function = ""
    for line in text.splitlines():
        if head := re.match(r"[0-9a-f]+ <(.*)>:$", line):
            function = head.group(1)
        elif found := re.match(r"\s+([0-9a-f]+):\s+(\S+)", line):
            yield int(found.group(1), 16), function, found.group(2)


def with_limit(kernel, instructions):
    executed = kernel.pop("instructions")
    arithmetic, divisions, everything, phases = 0, 0, 0, {}
    for address, function, mnemonic in instructions:
        count = executed.get(str(address), 0) / kernel["vector_steps"]
        everything += count
        if not count or not mnemonic.startswith("v") or MOVES.match(mnemonic):
            continue
        arithmetic += count
        divisions += count * bool(re.match(r"v(div|sqrt)", mnemonic))
        phase = re.search(r"::(?:run|(\w+))(?:<\d>)?\(", function).group(1) or "control"
        phases[phase] = phases.get(phase, 0) + count
    cycles = max(arithmetic * kernel["cycles_per_multiply_add"], divisions * kernel["cycles_per_division"])
    return kernel | {"all_per_vector_step": everything, "arithmetic_per_vector_step": arithmetic,
                     "divisions_per_vector_step": divisions, "phases": phases,
                     "limit_cycles_per_lane_step": cycles / kernel["width"]}


def main():
    with open(sys.argv[2], encoding="utf-8") as file:
        kernels = json.load(file)["kernel"]
    if not all(kernel and kernel["instructions"] for kernel in kernels.values()):
        print("null")  # another kind of processor, or a system that does not allow it
        return
    instructions = list(disassembled(sys.argv[1]))
    print(json.dumps({bending: with_limit(kernel, instructions) for bending, kernel in kernels.items()}, indent=1))


main()

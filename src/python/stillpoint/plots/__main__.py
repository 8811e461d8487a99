"""`python3 plots KIND DIR…`: this folder as a program, without the package around it and so without its compiled half."""

import sys
from importlib import import_module
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parent.parent)  # Python had put this folder there
program = import_module("plots.program")
del sys.path[0]  # what stands beside this folder has names that other modules may have as well
sys.exit(program.main())

"""Pictures of what runs and studies have left: `stillpoint plot KIND DIR` draws by them, and so do plot() and its like in Python.

They need numpy and matplotlib, and h5py to read fields.h5, but nothing that is compiled: any Python from 3.9 on runs this
folder as a program, `python3 plots history DIR`, whichever Python the package around it is for.
"""

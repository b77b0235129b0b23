"""Pictures of lobe render as arrays."""
import numpy


def read_pfm(path):
    with open(path, "rb") as file:
        file.readline()
        width, height = map(int, file.readline().split())
        file.readline()
        return numpy.frombuffer(file.read(), "<f4").reshape(height, width, 3)[::-1]

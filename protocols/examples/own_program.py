#!/usr/bin/env python3
"""A friction image from a photograph: its brightness, repeated over the display. Needs nothing but Python."""
import sys

photograph, image = sys.argv[-2:]
with open(photograph.replace(".png", ".ppm"), "rb") as file:
    kind, size, most, rgb = file.read().split(b"\n", 3)
width, height = map(int, size.split())
green = [rgb[3 * width * y + 1 : 3 * width * (y + 1) : 3] for y in range(height)]
rows = [(green[y % height] * (1280 // width + 1))[:1280] for y in range(800)]
with open(image, "wb") as file:
    file.write(b"P5\n1280 800\n255\n" + b"".join(rows))

"""scipy on the work of `vis2hap bench signals`. Prints {"peer": {"stage": {"ms": milliseconds, "answer": number} or null}}.

The slopes are those of the same weave (knownWeave() in study/bench/bench_signals.cpp). The answer is the root mean square height.
"""
import json

from timing import median

found = {'scipy': {}}
try:
    import numpy
    import scipy.fft
    pitch, rows, columns = 0.05, 480, 640
    yarn, wave = 2 * numpy.pi / 0.8, 2 * numpy.pi / 9.0
    y, x = numpy.mgrid[0:rows, 0:columns] * pitch
    height = (0.05 * numpy.cos(yarn * x) * numpy.cos(yarn * y) + 0.1 * numpy.sin(wave * (x + 0.4 * y))).astype('f4')
    swell = 0.1 * wave * numpy.cos(wave * (x + 0.4 * y))
    p = (-0.05 * yarn * numpy.sin(yarn * x) * numpy.cos(yarn * y) + swell).astype('f4')
    q = (-0.05 * yarn * numpy.cos(yarn * x) * numpy.sin(yarn * y) + 0.4 * swell).astype('f4')

    def there(a):
        return scipy.fft.dctn(a, norm='ortho', workers=1)

    def back(a):
        return scipy.fft.idctn(a, norm='ortho', workers=1)

    value = (((2 * numpy.sin(numpy.pi * numpy.arange(columns) / (2 * columns))) ** 2)[None]
             + ((2 * numpy.sin(numpy.pi * numpy.arange(rows) / (2 * rows))) ** 2)[:, None]).astype('f4')
    value[0, 0] = 1

    def integrate():
        right = (p[:, 1:] + p[:, :-1]) / 2 * numpy.float32(pitch)
        down = (q[1:] + q[:-1]) / 2 * numpy.float32(pitch)
        source = numpy.zeros_like(p)
        source[:, :-1] -= right
        source[:, 1:] += right
        source[:-1] -= down
        source[1:] += down
        spectrum = there(source) / value
        spectrum[0, 0] = 0
        return back(spectrum)

    found['scipy']['cosine transforms 480x640'] = {'ms': median(lambda: back(there(height)), 21)}
    found['scipy']['integration 480x640'] = {'ms': median(integrate, 21), 'answer': float(numpy.std(integrate().astype('f8')))}
except ImportError:
    pass  # a peer that is not installed stays null
print(json.dumps(found))

"""scipy on the work of `vis2hap bench signals`. Prints {"peer": {"stage": milliseconds or null}}."""
import json

from timing import median

found = {'scipy': {}}
try:
    import numpy
    import scipy.fft
    draw = numpy.random.default_rng(1)
    p, q = draw.random((480, 640)).astype('f4'), draw.random((480, 640)).astype('f4')

    def there(a):
        return scipy.fft.dctn(a, norm='ortho', workers=1)

    def back(a):
        return scipy.fft.idctn(a, norm='ortho', workers=1)

    found['scipy']['cosine transforms 480x640'] = median(lambda: back(there(p)), 21)
    x = (2 * numpy.sin(numpy.pi * numpy.arange(640) / 1280)) ** 2
    y = (2 * numpy.sin(numpy.pi * numpy.arange(480) / 960)) ** 2
    value = (x[None] + y[:, None]).astype('f4')
    value[0, 0] = 1

    def integrate():
        right = (p[:, 1:] + p[:, :-1]) / 2
        down = (q[1:] + q[:-1]) / 2
        source = numpy.zeros_like(p)
        source[:, :-1] -= right
        source[:, 1:] += right
        source[:-1] -= down
        source[1:] += down
        spectrum = there(source) / value
        spectrum[0, 0] = 0
        return back(spectrum)

    found['scipy']['integration 480x640'] = median(integrate, 21)
except ImportError:
    pass  # a peer that is not installed stays null
print(json.dumps(found))

"""scipy, scikit-image and OpenCV on the work of `vis2hap bench statistics`, with the same numbers.

Prints {"peer": {"stage": {"ms": milliseconds, "answer": number} or null}}.
"""
import json

from timing import median

found = {}


def measured(work, repeats, answer):
    return {'ms': median(work, repeats), 'answer': float(answer(work()))}


def sequence(n, multiplier, increment):
    i = numpy.arange(n, dtype=numpy.uint64)
    return ((i * numpy.uint64(multiplier) + numpy.uint64(increment)) & numpy.uint64(0xFFFFFFFF)) / 4294967296.0


def images():
    a, b = sequence(1280 * 800, 2654435761, 12345), sequence(1280 * 800, 3266489917, 99)
    return a.reshape(800, 1280), (0.8 * a + 0.2 * b).reshape(800, 1280)


try:
    import numpy
    import scipy.stats
    x, y = sequence(1000000, 2654435761, 12345), sequence(1000000, 3266489917, 99)
    d = numpy.round((sequence(70, 2654435761, 777) - 0.45) * 60) / 10
    found['scipy'] = {
        'paired t': measured(lambda: scipy.stats.ttest_rel(x, y), 7, lambda test: test.statistic),
        'bca': measured(lambda: scipy.stats.bootstrap((d,), numpy.mean, n_resamples=10000, method='BCa', random_state=1), 5,
                        lambda interval: interval.confidence_interval.low)}
except ImportError:
    pass  # a peer that is not installed stays null
try:
    import numpy
    from skimage.metrics import structural_similarity
    a, b = images()
    options = dict(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0)
    found['scikit-image'] = {'ssim': measured(lambda: structural_similarity(a, b, **options), 3, float)}
    a, b = a.astype('f4'), b.astype('f4')
    found['scikit-image']['ssim float'] = measured(lambda: structural_similarity(a, b, **options), 3, float)
except ImportError:
    pass  # a peer that is not installed stays null
try:
    import cv2
    import numpy
    from opencv_ssim import ssim
    cv2.setNumThreads(1)
    a, b = images()
    found['OpenCV'] = {'ssim': measured(lambda: ssim(a, b, 1.0), 3, float)}
    a, b = a.astype('f4'), b.astype('f4')
    found['OpenCV']['ssim float'] = measured(lambda: ssim(a, b, 1.0), 3, float)
except ImportError:
    pass  # a peer that is not installed stays null
print(json.dumps(found))

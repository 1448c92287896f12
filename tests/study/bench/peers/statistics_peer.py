"""scipy and scikit-image on the work of `vis2hap bench statistics`. Prints {"peer": {"stage": milliseconds or null}}."""
import json

from timing import median

found = {'scipy': {'paired t': None, 'bca': None}, 'scikit-image': {'ssim': None, 'ssim float': None}}
try:
    import numpy
    import scipy.stats
    draw = numpy.random.default_rng(1)
    x, y, d = draw.random(1000000), draw.random(1000000), draw.normal(size=70).round(1)
    found['scipy']['paired t'] = median(lambda: scipy.stats.ttest_rel(x, y), 7)
    found['scipy']['bca'] = median(lambda: scipy.stats.bootstrap((d,), numpy.mean, n_resamples=10000, method='BCa'), 5)
except ImportError:
    pass  # a peer that is not installed stays null
try:
    import numpy
    from skimage.metrics import structural_similarity as ssim
    draw = numpy.random.default_rng(1)
    a = draw.random((800, 1280))
    b = 0.8 * a + 0.2 * draw.random((800, 1280))
    options = dict(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0)
    found['scikit-image']['ssim'] = median(lambda: ssim(a, b, **options), 3)
    a, b = a.astype('f4'), b.astype('f4')
    found['scikit-image']['ssim float'] = median(lambda: ssim(a, b, **options), 3)
except ImportError:
    pass  # a peer that is not installed stays null
print(json.dumps(found))

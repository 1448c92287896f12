"""scipy, scikit-image and OpenCV on the extreme inputs of `vis2hap bench extremes`.

Argument: a file with one case a line: number, operation, and rows of hexadecimal doubles, parted by tabs. Each answer is a line:
number, peer, "number" or "refused", the number or the reason, milliseconds. Cases without a function here are left out.
"""
import sys
import time
import warnings

import timing  # one thread

assert timing
warnings.filterwarnings('ignore')
peers = {}


def operation(peer, name):
    def keep(work):
        peers.setdefault(name, []).append((peer, work))
        return work
    return keep


try:
    import numpy
    import scipy.fft
    import scipy.signal
    from scipy import stats

    @operation('scipy', 'one sample t')
    def one_sample_t(x, mu):
        return stats.ttest_1samp(x, mu[0]).statistic

    @operation('scipy', 'one sample p')
    def one_sample_p(x, mu):
        return stats.ttest_1samp(x, mu[0]).pvalue

    @operation('scipy', 'one sample high')
    def one_sample_high(x, mu):
        return stats.ttest_1samp(x, mu[0]).confidence_interval(0.95).high

    @operation('scipy', 'mean')
    def mean(x):
        return numpy.mean(x)

    @operation('scipy', 'variance')
    def variance(x):
        return stats.tvar(x)

    @operation('scipy', 'standard deviation')
    def standard_deviation(x):
        return stats.tstd(x)

    @operation('scipy', 'autocorrelation')
    def autocorrelation(x):
        d = x - numpy.mean(x)
        return numpy.dot(d[:-1], d[1:]) / numpy.dot(d, d)

    @operation('scipy', 'mean absolute error')
    def mean_absolute_error(a, b):
        return numpy.mean(numpy.abs(a - b))

    @operation('scipy', 'anova F')
    def anova_f(*groups):
        return stats.f_oneway(*groups).statistic

    @operation('scipy', 'log p of t')
    def log_p_of_t(x):
        return numpy.log(2) + stats.t.logsf(x[0], x[1])

    @operation('scipy', 'log p of count')
    def log_p_of_count(x):
        return numpy.log(stats.binomtest(int(x[0]), int(x[1]), x[2], alternative='greater').pvalue)

    @operation('scipy', 'p of count')
    def p_of_count(x):
        return stats.binomtest(int(x[0]), int(x[1]), x[2], alternative='greater').pvalue

    @operation('scipy', 'clopper high')
    def clopper_high(x):
        return stats.binomtest(int(x[0]), int(x[1])).proportion_ci(0.95, 'exact').high

    @operation('scipy', 'wilcoxon p')
    def wilcoxon_p(x, y):
        return stats.wilcoxon(x, y, mode='exact').pvalue

    @operation('scipy', 'tost p')
    def tost_p(x, bounds):
        return max(stats.ttest_1samp(x, bounds[0], alternative='greater').pvalue,
                   stats.ttest_1samp(x, bounds[1], alternative='less').pvalue)

    @operation('scipy', 'bca low')
    def bca_low(x):
        return stats.bootstrap((x,), numpy.mean, method='BCa', random_state=1).confidence_interval.low

    @operation('scipy', 'friedman q')
    def friedman_q(*rows):
        return stats.friedmanchisquare(*numpy.array(rows).T).statistic

    @operation('scipy', 'rise of a plane')
    def rise_of_a_plane(x):
        rows, columns, slope, pitch = int(x[0]), int(x[1]), x[2], x[3]
        p = numpy.full((rows, columns), slope)
        source = numpy.zeros_like(p)
        right = (p[:, 1:] + p[:, :-1]) / 2 * pitch
        source[:, :-1] -= right
        source[:, 1:] += right
        value = ((2 * numpy.sin(numpy.pi * numpy.arange(columns) / (2 * columns))) ** 2)[None] + (
            (2 * numpy.sin(numpy.pi * numpy.arange(rows) / (2 * rows))) ** 2)[:, None]
        value[0, 0] = 1
        spectrum = scipy.fft.dctn(source, norm='ortho') / value
        spectrum[0, 0] = 0
        height = scipy.fft.idctn(spectrum, norm='ortho')
        return height[0, -1] - height[0, 0]

    @operation('scipy', 'spectrogram and back')
    def spectrogram_and_back(x):
        _, _, spectrum = scipy.signal.stft(x, nperseg=64, noverlap=48)
        _, back = scipy.signal.istft(spectrum, nperseg=64, noverlap=48)
        return numpy.max(numpy.abs(back[:len(x)] - x)) / max(numpy.max(numpy.abs(x)), 1e-300)
except ImportError:
    pass  # a peer that is not installed gives no answer

try:
    import numpy
    from skimage.metrics import structural_similarity

    def similarity(size, a, b, kind):
        shape = int(size[1]), int(size[0])
        return structural_similarity(a.reshape(shape).astype(kind), b.reshape(shape).astype(kind), gaussian_weights=True,
                                     sigma=1.5, use_sample_covariance=False, data_range=size[2])

    operation('scikit-image', 'ssim')(lambda size, a, b: similarity(size, a, b, 'f8'))
    operation('scikit-image', 'ssim float')(lambda size, a, b: similarity(size, a, b, 'f4'))
except ImportError:
    pass

try:
    import cv2
    import numpy
    from opencv_ssim import ssim

    def recipe(size, a, b, kind):
        shape = int(size[1]), int(size[0])
        return ssim(a.reshape(shape).astype(kind), b.reshape(shape).astype(kind), size[2])

    operation('OpenCV', 'ssim')(lambda size, a, b: recipe(size, a, b, 'f8'))
    operation('OpenCV', 'ssim float')(lambda size, a, b: recipe(size, a, b, 'f4'))

    @operation('OpenCV', 'standard deviation')
    def deviation(x):
        return cv2.meanStdDev(x)[1][0][0] * numpy.sqrt(len(x) / (len(x) - 1))

    @operation('OpenCV', 'grey of 16 bits')
    def grey(x):
        return cv2.cvtColor(numpy.array([[x]], 'u2'), cv2.COLOR_RGB2GRAY)[0, 0]
except ImportError:
    pass


def answer(work, rows):
    start = time.perf_counter()
    try:
        found = float(work(*rows))
        kind, text = ('refused', 'the answer is NaN') if found != found else ('number', repr(found))
    except Exception as fault:  # whatever a peer objects to is its refusal
        kind, text = 'refused', ' '.join(str(fault).split())[:160] or type(fault).__name__
    return kind, text, str(1000 * (time.perf_counter() - start))


with open(sys.argv[1]) as file:
    for line in file:
        number, name, *fields = line.rstrip('\n').split('\t')
        for peer, work in peers.get(name, []):
            arrays = [numpy.array([float.fromhex(word) for word in field.split()]) for field in fields]
            answer(work, arrays)  # the first call of a function loads parts of the library
            print(number, peer, *answer(work, arrays), sep='\t')

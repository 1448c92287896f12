# /usr/bin/python3 tests/stats/reference/signals.py (scipy 1.10): the numbers of tests/stats/signals_test.cpp and of the
# speed and accuracy measures in tests/stats/statistics_test.cpp.
import numpy as np
from scipy import signal, stats


def show(name, value):
    print('%s\t%.15g' % (name, value))


i = np.arange(300)
x = np.sin(0.3 * i) + 0.1 * ((37 * i) % 11)
i = np.arange(260)
y = 1.5 * np.sin(0.3 * i + 1) + 0.1 * ((29 * i) % 13)


def spectrum(v, segment):
    return signal.welch(v, window='hann', nperseg=segment, noverlap=segment // 2, detrend='constant', scaling='spectrum')[1]


for segment in (64, 17):
    d = 10 * np.log10(spectrum(x, segment) / spectrum(y, segment))[1:]
    show('spectrum.%d' % segment, np.sqrt((d**2).mean()))
    show('spectrum.bias.%d' % segment, d.mean())
# Unnormalised: the sum over the segments of |DFT of window x (values - mean)|^2.
n = 9
window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(n) / n)
parts = [x[a:a + n] for a in range(0, 30 - n + 1, n - n // 2)]
power = sum(abs(np.fft.rfft(window * (part - part.mean())))**2 for part in parts)
for f, value in enumerate(power):
    show('power.%d' % f, value)

g = np.array([0.31, 0.42, 0.28, 0.55, 0.47, 0.36])
t = np.array([0.30, 0.45, 0.33, 0.41, 0.49, 0.30])
show('error.mae', abs(g - t).mean())
show('error.mean', t.mean())
show('error.ratio', abs(g - t).mean() / t.mean())
show('error.rmse', np.sqrt(((g - t)**2).mean()))
show('error.bias', (g - t).mean())
show('error.max', abs(g - t).max())

# Liesefeld and Janczyk (2019): z of the proportions minus z of the times, with the population's SD.
rt = np.array([356.8, 325.1, 370.6, 362.8, 348.5, 640.3, 634.2, 650.7, 584.5, 610.0])
pc = np.array([.71, .73, .67, .73, .72, .97, .99, .99, .97, .97])
for i, value in enumerate(stats.zscore(pc) - stats.zscore(rt)):
    show('bis.%d' % i, value)
seconds = np.array([1.2, 0.8, 3.1, 2.4, 0.9, 1.7])
show('times.median', np.median(seconds))
show('times.mean', seconds.mean())
show('times.logMean', np.log(seconds).mean())
show('times.geometric', stats.gmean(seconds))
for m, p in ((3, 0.7), (2, 0.9), (4, 0.26)):
    show('bits.%d' % m, np.log2(m) + p * np.log2(p) + (1 - p) * np.log2((1 - p) / (m - 1)))

# /usr/bin/python3 tests/stats/reference/resampling.py (numpy, scipy 1.10): the BCa bootstrap of tests/stats/resampling_test.cpp,
# written a second time from Efron (1987) with the same draws: SplitMix64, one stream for every 64 resamples, two draws a number.
import numpy as np
from scipy import stats

MASK = 2**64 - 1


def show(name, value):
    print('%s\t%.15g' % (name, value))


def mixed(z):
    z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
    return z ^ (z >> 31)


class Draws:
    def __init__(self, seed, stream):
        self.state = mixed((mixed(seed) + stream) & MASK)

    def bits(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        return mixed(self.state)

    def uniform(self):
        return ((self.bits() >> 12) + 0.5) * 2.0**-52

    def normal(self):
        while True:
            x = 2 * self.uniform() - 1
            y = 2 * self.uniform() - 1
            square = x * x + y * y
            if 0 < square < 1:
                return x * np.sqrt(-2 * np.log(square) / square)


def bca(name, x, resamples, confidence, seed):
    x = np.sort(np.array(x))
    n = len(x)
    means = []
    for i in range(resamples):
        if i % 64 == 0:
            draws = Draws(seed, i // 64)
        drawn = []
        for _ in range(n // 2):
            bits = draws.bits()
            drawn += [x[(bits & 0xFFFFFFFF) * n >> 32], x[(bits >> 32) * n >> 32]]
        if n % 2 == 1:
            drawn.append(x[(draws.bits() >> 32) * n >> 32])
        means.append(sum(drawn) / n)
    means = np.array(means)
    mean = x.mean()
    tied = abs(means - mean) < 1e-12
    below = ((means < mean) & ~tied).mean() + tied.mean() / 2
    z0 = stats.norm.ppf(below)
    a = ((x - mean)**3).sum() / (6 * ((x - mean)**2).sum()**1.5)
    z = stats.norm.ppf((1 + confidence) / 2)
    ends = [np.quantile(means, stats.norm.cdf(z0 + (z0 + s) / (1 - a * (z0 + s)))) for s in (-z, z)]
    show(name + '.se', means.std())
    show(name + '.bias', z0)
    show(name + '.a', a)
    show(name + '.low', ends[0])
    show(name + '.high', ends[1])


bca('even', [2.1, 3.4, 1.9, 5.6, 4.4, 2.2, 7.9, 3.1, 2.8, 4.0], 1000, 0.95, 1)
bca('odd', [0.3, -0.1, 0.5, 0.5, 0.2, -0.4, 0.6], 777, 0.9, 9)
# Roots lie on no decimal grid.
bca('roots', [2**0.5, 3**0.5, 5**0.5, 7**0.5, 11**0.5], 500, 0.95, 3)

draws = Draws(7, 3)
print('bits.first\t%d' % draws.bits())
print('bits.second\t%d' % draws.bits())
draws = Draws(7, 3)
show('uniform', draws.uniform())
show('normal.1', draws.normal())
show('normal.2', draws.normal())
show('normal.3', draws.normal())

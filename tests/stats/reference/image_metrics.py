# /usr/bin/python3 tests/stats/reference/image_metrics.py (numpy): the SSIM numbers of tests/stats/image_metrics_test.cpp, every window
# by itself in long double, as Wang et al. (2004) define it; and the shift of the largest correlation by trying all.
import numpy as np


def show(name, value):
    print('%s\t%.15g' % (name, value))


def gaussian():
    w = np.exp(-(np.arange(11) - 5.0)**2 / (2 * 1.5**2)).astype(np.longdouble)
    return np.outer(w, w) / w.sum()**2


def box():
    return np.full((7, 7), np.longdouble(1) / 49)


def ssim(a, b, L, window, sample=False, k1=0.01, k2=0.03):
    a, b = a.astype(np.longdouble), b.astype(np.longdouble)
    n = window.shape[0]
    c1, c2 = (k1 * L)**2, (k2 * L)**2
    factor = n * n / (n * n - 1) if sample else 1
    values = []
    for y in range(a.shape[0] - n + 1):
        for x in range(a.shape[1] - n + 1):
            p, q = a[y:y + n, x:x + n], b[y:y + n, x:x + n]
            mp, mq = (window * p).sum(), (window * q).sum()
            vp, vq, cov = ((factor * window * d).sum() for d in ((p - mp)**2, (q - mq)**2, (p - mp) * (q - mq)))
            values.append((2 * mp * mq + c1) * (2 * cov + c2) / ((mp**2 + mq**2 + c1) * (vp + vq + c2)))
    return np.mean(values), min(values), max(values)


# Wider and higher than a tile of 64 windows, and not a multiple of it.
i, j = np.mgrid[0:81, 0:90]
a = ((7 * i + 13 * j) % 17) / 17.0
b = ((7 * i + 13 * j + i * j % 3) % 17) / 17.0 + 0.002 * i
for name, options in (('gaussian', (1, gaussian())), ('sample', (1, gaussian(), True)), ('box', (1, box())), ('boxSample', (1, box(), True)),
                      ('range', (2.5, gaussian())), ('k', (1, gaussian(), False, 0.02, 0.05))):
    for field, value in zip(('mean', 'least', 'most'), ssim(a, b, *options)):
        show('%s.%s' % (name, field), value)

# b lies 3 right of and 2 above a, under a pattern of its own: b(x + 3, y - 2) = a(x, y) + noise.
i, j = np.mgrid[0:30, 0:34]
texture = lambda i, j: np.sin(0.7 * i + 0.3 * j) + np.cos(0.2 * i * i / 10 + 0.9 * j)
first = texture(i, j)
second = texture(i + 2, j - 3) + 0.1 * ((5 * i + 3 * j) % 7)
best = None
for down in range(-5, 6):
    for right in range(-5, 6):
        p = first[max(0, -down):30 - max(0, down), max(0, -right):34 - max(0, right)]
        q = second[max(0, down):30 - max(0, -down), max(0, right):34 - max(0, -right)]
        r = np.corrcoef(p.ravel(), q.ravel())[0, 1]
        if best is None or r > best[0]:
            best = (r, right, down, p, q)
show('registered.r', best[0])
show('registered.right', best[1])
show('registered.down', best[2])
show('registered.ssim', ssim(best[3], best[4], 2, gaussian())[0])
show('registered.plain', ssim(first, second, 2, gaussian())[0])

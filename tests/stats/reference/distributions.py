# /usr/bin/python3 tests/stats/reference/distributions.py (mpmath 1.2, 60 digits): the numbers of tests/stats/distributions_test.cpp.
from mpmath import mp, mpf, betainc, gammainc, gamma, log, sqrt, erfc, quad, inf, pi, exp, hyp1f1, findroot, besseli, ncdf, npdf

mp.dps = 60


def show(name, value):
    print('%s\t%s' % (name, mp.nstr(mpf(value), 17, min_fixed=-4, max_fixed=6)))


def beta(a, b, x):
    return betainc(a, b, 0, x, regularized=True)


def student(t, df):
    t, df = mpf(t), mpf(df)
    return beta(df / 2, mpf(1) / 2, df / (df + t * t)) / 2


def fisher(f, d1, d2):
    f, d1, d2 = mpf(f), mpf(d1), mpf(d2)
    return beta(d2 / 2, d1 / 2, d2 / (d2 + d1 * f))


def chi(x, df):
    return gammainc(mpf(df) / 2, mpf(x) / 2, inf, regularized=True)


def both(name, p):
    show(name + '.p', p)
    show(name + '.log', log(p))


both('t.a', student(2.5, 7))
both('t.b', student('0.3', '2.25'))
both('t.negative', 1 - student(1.75, 4))
both('t.far', student(200, 300))
both('t.farther', student('1e7', 9))
both('t2.near', 1 - beta(mpf(1) / 2, mpf(7) / 2, mpf('0.25')**2 / (7 + mpf('0.25')**2)))
both('t2.plain', 2 * student(2.5, 7))
both('f.a', fisher('3.7', 2, 11))
both('f.b', fisher('0.2', '3.5', '8.25'))
both('f.far', fisher(5000, 40, 300))
both('chi.a', chi('7.5', 3))
both('chi.b', chi('0.5', 5))
both('chi.far', chi(1500, 4))
both('z.a', erfc(mpf('1.96') / sqrt(2)) / 2)
both('z.negative', 1 - erfc(mpf('0.7') / sqrt(2)) / 2)
both('z.far', erfc(mpf(40) / sqrt(2)) / 2)
show('beta.lower', beta(mpf('3.5'), 2, mpf('0.4')))
show('beta.upper', 1 - beta(mpf('3.5'), 2, mpf('0.4')))
show('beta.quantile', findroot(lambda x: beta(mpf('3.5'), 2, x) - mpf('0.3'), mpf('0.5')))
show('t.quantile', findroot(lambda t: student(t, mpf('6.5')) - mpf('0.025'), 2))
show('z.quantile', findroot(lambda z: erfc(z / sqrt(2)) / 2 - mpf('0.01'), 2))
show('f.quantile', findroot(lambda f: fisher(f, 3, 14) - mpf('0.05'), 3))
show('chi.quantile', findroot(lambda x: chi(x, 5) - mpf('0.1'), 9))
for m in (2, 5, 40):
    m = mpf(m)
    show('hedges.%d' % m, gamma(m / 2) / (sqrt(m / 2) * gamma((m - 1) / 2)))

# Noncentral: the definitions as integrals over the chi-squared variable, and as Poisson mixtures.
mp.dps = 30


def chi_density(x, df):
    df = mpf(df)
    return x**(df / 2 - 1) * exp(-x / 2) / (2**(df / 2) * gamma(df / 2))


def noncentral_t(t, df, delta):
    return quad(lambda x: chi_density(x, df) * ncdf(mpf(delta) - mpf(t) * sqrt(x / df)), [0, df / 2, df, 2 * df, 4 * df, 20 * df])


def poisson(lam, tail):
    lam = mpf(lam)
    weight, total = exp(-lam / 2), mpf(0)
    for j in range(400):
        total += weight * tail(j)
        weight *= lam / 2 / (j + 1)
    return total


show('nct.a', noncentral_t('2.262157', 9, 3))
show('nct.b', noncentral_t('2.1', 5, '-0.7'))
show('ncf.a', poisson(10, lambda j: beta(mpf(72) / 2, mpf(8) / 2 + j, 72 / (72 + mpf(8) * 2))))
show('ncf.b', poisson('3.25', lambda j: beta(mpf(11) / 2, mpf(3) / 2 + j, 11 / (11 + mpf(3) * mpf('4.5')))))
show('ncchi.a', poisson(10, lambda j: gammainc(mpf(8) / 2 + j, mpf('15.507') / 2, inf, regularized=True)))
show('ncchi.b', poisson('2.5', lambda j: gammainc(mpf(3) / 2 + j, mpf(4) / 2, inf, regularized=True)))

# Beyond the series: Patnaik (1949) for chi-squared and F, the chi-squared variable alone for t.
lam = mpf(10001)
show('large.chi', chi(10000 * (8 + lam) / (8 + 2 * lam), (8 + lam)**2 / (8 + 2 * lam)))
show('large.f', fisher(1200 * 8 / (8 + lam), (8 + lam)**2 / (8 + 2 * lam), 72))
show('large.t', 1 - chi(9 * (mpf(3001) / 3100)**2, 9))

# d' of an m-alternative forced choice (Green and Swets 1966), its standard error by the delta method.


def correct(d, m):
    return quad(lambda x: npdf(x - d) * ncdf(x)**(m - 1), [d - 12, d - 4, d, d + 4, d + 12])


for k, n, m in ((27, 70, 3), (50, 70, 4), (69, 70, 2), (24, 70, 3)):
    p = mpf(k) / n
    d = findroot(lambda x: correct(x, m) - p, (mpf('0.5'), mpf(1)))
    slope = (m - 1) * quad(lambda x: npdf(x - d) * npdf(x) * ncdf(x)**(m - 2), [-12, -4, 0, d, d + 4, d + 12])
    show('d.%d.%d' % (k, m), d)
    show('se.%d.%d' % (k, m), sqrt(p * (1 - p) / n) / slope)
show('correct', correct(mpf('1.3'), 5))

# The JZS Bayes factor: Rouder et al. (2009), equation 1 with the prior's scale r.


def jzs(t, n, r):
    t, n, r = mpf(t), mpf(n), mpf(r)
    nu = n - 1
    one = quad(lambda g: (1 + n * g * r * r)**(-mpf(1) / 2) * (1 + t * t / ((1 + n * g * r * r) * nu))**(-(nu + 1) / 2)
               * (2 * pi)**(-mpf(1) / 2) * g**(-mpf(3) / 2) * exp(-1 / (2 * g)), [0, 0.1, 1, 10, 100, inf])
    return one / (1 + t * t / nu)**(-(nu + 1) / 2)


show('jzs.a', jzs('2.03', 80, sqrt(2) / 2))
show('jzs.b', jzs('-1.5', 24, 1))
show('jzs.c', jzs(8, 30, sqrt(2)))
show('jzs.d', jzs(0, 2, '0.3'))
show('jzs.e', jzs('0.4', 12, '0.05'))

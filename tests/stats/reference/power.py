# /usr/bin/python3 tests/stats/reference/power.py (mpmath, numpy): the numbers of tests/stats/power_test.cpp. Noncentral tails as integrals
# and Poisson mixtures; drawn studies written a second time from the same streams (resampling.py has the generator).
import contextlib
import io
import os
import sys

from mpmath import mp, mpf, betainc, gammainc, gamma, sqrt, quad, exp, inf, ncdf, findroot, pi, log

sys.path.insert(0, os.path.dirname(__file__))
with contextlib.redirect_stdout(io.StringIO()):
    from resampling import Draws

mp.dps = 25


def show(name, value):
    print('%s\t%s' % (name, mp.nstr(mpf(value), 15, min_fixed=-4, max_fixed=6)))


def t_upper(t, df):
    return betainc(mpf(df) / 2, mpf(1) / 2, 0, df / (df + t * t), regularized=True) / 2


def t_quantile(upper, df):
    return findroot(lambda t: t_upper(t, df) - upper, 2)


def f_upper(f, d1, d2):
    return betainc(mpf(d2) / 2, mpf(d1) / 2, 0, d2 / (d2 + d1 * f), regularized=True)


def chi_density(x, df):
    df = mpf(df)
    return x**(df / 2 - 1) * exp(-x / 2) / (2**(df / 2) * gamma(df / 2))


def two_sided(df, delta, alpha):
    t = t_quantile(mpf(alpha) / 2, df)
    ends = [0, df / 2, df, 2 * df, 4 * df, 20 * df]
    return quad(lambda x: chi_density(x, df) * (ncdf(delta - t * sqrt(x / df)) + ncdf(-delta - t * sqrt(x / df))), ends)


def poisson(lam, tail):
    weight, total = exp(-mpf(lam) / 2), mpf(0)
    for j in range(300):
        total += weight * tail(j)
        weight *= mpf(lam) / 2 / (j + 1)
    return total


def f_power(d1, d2, lam, alpha):
    d1, d2 = mpf(d1), mpf(d2)
    f = findroot(lambda f: f_upper(f, d1, d2) - alpha, 3)
    return poisson(lam, lambda j: betainc(d2 / 2, d1 / 2 + j, 0, d2 / (d2 + d1 * f), regularized=True))


def chi_power(df, lam, alpha):
    df = mpf(df)
    x = findroot(lambda x: gammainc(df / 2, x / 2, inf, regularized=True) - alpha, df + 5)
    return poisson(lam, lambda j: gammainc(df / 2 + j, x / 2, inf, regularized=True))


def t_power(n, effect, alpha=0.05):
    return two_sided(mpf(n - 1), mpf(effect) * sqrt(n), alpha)


def tost_power(n, sd, low, high, alpha, difference):
    df, se = mpf(n - 1), mpf(sd) / sqrt(n)
    t = t_quantile(mpf(alpha), df)
    widest = (mpf(high) - mpf(low)) / (2 * t * se)
    inside = lambda s: (ncdf((high - mpf(difference)) / se - t * s) - ncdf((low - mpf(difference)) / se + t * s)) * 2 * df * s * chi_density(
        df * s * s, df)
    return quad(inside, [0, widest / 4, widest / 2, 3 * widest / 4, widest])


def binomial_upper(k, n, p):
    return betainc(k, n - k + 1, 0, p, regularized=True) if k > 0 else mpf(1)


def binomial_power(n, chance, alpha, p):
    k = next((k for k in range(n + 1) if binomial_upper(k, n, chance) <= alpha), None)
    return mpf(0) if k is None else binomial_upper(k, n, p)


class Design:
    participants, fabrics, conditions, alternatives = 6, 5, 4, 3
    participant_condition, fabric_condition, residual = mpf('0.15'), mpf('0.05'), mpf('0.85')

    def __init__(self, participants=6):
        self.participants = participants

    def sd_of_difference(self):
        return sqrt(2 * (self.participant_condition + self.residual / self.fabrics))

    def variance_of_mean(self):
        p, f = self.participants, self.fabrics
        return self.participant_condition / p + self.fabric_condition / f + self.residual / (p * f)

    def df_of_mean(self):
        p, f, k = self.participants, self.fabrics, self.conditions
        a, b, c = self.residual + f * self.participant_condition, self.residual + p * self.fabric_condition, self.residual
        return (a + b - c)**2 / (a**2 / ((p - 1) * (k - 1)) + b**2 / ((f - 1) * (k - 1)) + c**2 / (k * (p - 1) * (f - 1)))

    def spread(self, r):
        k = self.conditions
        return sum((mpf(r) * (mpf(c) / (k - 1) - mpf(1) / 2))**2 for c in range(k))


# Every test that a study plans: power(design, effect), the effects, the largest effect.
pairs = 6
chance = mpf(1) / 3
tests = [
    ('pairedT', lambda d, e: t_power(d.participants, e / d.sd_of_difference()), (0.5, 1, 1.5), 10),
    ('pairedTHolm', lambda d, e: t_power(d.participants, e / d.sd_of_difference(), mpf('0.05') / pairs), (0.5, 1, 1.5), 10),
    ('tost', lambda d, e: tost_power(d.participants, d.sd_of_difference(), -0.4, mpf('0.8'), 0.05, e), (mpf('0.2'), mpf('0.35'), mpf('0.5')), None),
    ('modelT', lambda d, e: two_sided(d.df_of_mean(), e / sqrt(2 * d.variance_of_mean()), 0.05), (0.5, 1, 1.5), 10),
    ('anova', lambda d, e: f_power(3, 3 * (d.participants - 1), d.participants * d.spread(e) / (d.participant_condition + d.residual / 5), 0.05),
     (0.5, 1, 1.5), 10),
    ('friedman', lambda d, e: chi_power(3, 12 / (5 * pi) * d.participants * d.spread(e) / (d.participant_condition + d.residual / 5), 0.05),
     (0.5, 1, 1.5), 10),
    ('modelF', lambda d, e: f_power(3, d.df_of_mean(), d.spread(e) / d.variance_of_mean(), 0.05), (0.5, 1, 1.5), 10),
    ('binomial', lambda d, e: binomial_power(5 * d.participants, chance, 0.05, chance + e), (0.1, mpf(1) / 6, mpf('0.4') * 2 / 3), mpf(2) / 3),
    ('binomialHolm', lambda d, e: binomial_power(5 * d.participants, chance, mpf('0.05') / 4, chance + e),
     (0.1, mpf(1) / 6, mpf('0.4') * 2 / 3), mpf(2) / 3),
    ('shares', lambda d, e: t_power(d.participants, e / sqrt((chance + e) * (1 - chance - e) / 5)), (0.1, mpf(1) / 6, mpf('0.4') * 2 / 3), mpf(2) / 3),
    ('choices', lambda d, e: chi_power(3, 5 * d.participants * d.spread(e) / 4, 0.05), (0.5, 1, 1.5), 10),
]


def participants(power, effect):
    """The smallest number from 2 to 1000 with power 0.8; all but the exact binomial test rise with it."""
    return next((n for n in range(2, 120) if power(Design(n), effect) >= mpf('0.8')), 0)


if __name__ == '__main__':
    design = Design()
    show('sd', design.sd_of_difference())
    show('variance', design.variance_of_mean())
    for name, power, effects, most in tests:
        for k, effect in enumerate(effects):
            show('%s.%d' % (name, k), power(design, mpf(effect)))
        if most and not name.startswith('binomial'):
            show(name + '.detectable', findroot(lambda e: power(design, e) - mpf('0.8'), (mpf(most) / 12, mpf(most) / 6), solver='anderson', tol=1e-20))
        show(name + '.participants', participants(power, mpf(effects[2])))
    # The exact binomial test's critical count does not depend on the effect.
    for name, alpha in (('binomial', mpf('0.05')), ('binomialHolm', mpf('0.05') / 4)):
        k = next(k for k in range(31) if binomial_upper(k, 30, chance) <= alpha)
        show(name + '.critical', k)
        show(name + '.detectable', findroot(lambda e: binomial_upper(k, 30, chance + e) - mpf('0.8'), mpf('0.25')))
    show('tost.narrowest', findroot(lambda b: tost_power(6, design.sd_of_difference(), -b, b, 0.05, 0) - mpf('0.8'), 1))
    for k, effect in enumerate((0.5, 1, 1.5)):
        show('fabrics.%d' % k, t_power(5, effect))
    show('fabrics.detectable', findroot(lambda e: t_power(5, e) - mpf('0.8'), 1.7))
    show('tost.skew', tost_power(9, 0.6, -0.5, 0.9, 0.025, 0.1))
    show('t.alpha', t_power(7, 0.8, 0.01))
    show('binomial.17', binomial_power(17, mpf('0.25'), 0.01, mpf('0.6')))

    # Ratings and choices of 2 participants, 2 fabrics, 3 conditions: stream 5 of seed 11.
    def normals(draws, n, variance):
        return [draws.normal() * variance**0.5 for _ in range(n)]

    draws = Draws(11, 5)
    who, what = normals(draws, 2, 0.5), normals(draws, 2, 0.2)
    who_how, what_how = normals(draws, 6, 0.15), normals(draws, 6, 0.05)
    ratings = []
    for p in range(2):
        for f in range(2):
            for c in range(3):
                value = 5.5 + (0, 0.5, 4.5)[c] + who[p] + what[f] + who_how[3 * p + c] + what_how[3 * f + c] + draws.normal() * 0.85**0.5
                ratings.append(min(100, max(0, round(value * 10))) / 10)
    print('# ratings', ratings)
    draws = Draws(11, 6)
    who, what = normals(draws, 2, 0.25), normals(draws, 2, 0.16)
    choices = []
    for p in range(2):
        for f in range(2):
            for c in range(3):
                choices.append(1 if draws.uniform() < 1 / (1 + exp(-((-1, 0, 1)[c] + who[p] + what[f]))) else 0)
    print('# choices', choices)

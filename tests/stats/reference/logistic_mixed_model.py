# /usr/bin/python3 tests/stats/reference/logistic_mixed_model.py (mpmath, 40 digits; a minute): the numbers of
# tests/stats/logistic_mixed_model_test.cpp. Laplace's approximation with dense matrices, the mode by Newton's method, the maximum by
# Newton's method with central differences. Standard errors are from the curvature of the criterion whose mode follows the parameters
# by one Newton step from the mode of the fit, as lme4 has them (see stats/models/laplace_criterion.h).
from mpmath import mp, mpf, matrix, exp, log, sqrt, erfc, lu_solve, det, diag, eye, gammainc, inf

mp.dps = 40


def show(name, value):
    print('%s\t%s' % (name, mp.nstr(mpf(value), 15, min_fixed=-4, max_fixed=6)))


class Criterion:
    """-2 log likelihood of standard deviations (one a group) and log odds (one a cell)."""

    def __init__(self, y, cell, groups):
        self.y, self.cell, self.groups = y, cell, groups
        self.sizes = [max(g) + 1 for g in groups]
        self.q = sum(self.sizes)
        self.u = matrix(self.q, 1)

    def columns(self, i):
        start = 0
        for g, size in zip(self.groups, self.sizes):
            yield start + g[i]
            start += size

    def scale(self, sd):
        return [s for s, size in zip(sd, self.sizes) for _ in range(size)]

    def eta(self, theta, u):
        sd = self.scale(theta[:len(self.groups)])
        return [theta[len(self.groups) + self.cell[i]] + sum(sd[j] * u[j] for j in self.columns(i)) for i in range(len(self.y))]

    def information(self, theta, w):
        sd = self.scale(theta[:len(self.groups)])
        M = eye(self.q)
        for i in range(len(self.y)):
            for j in self.columns(i):
                for k in self.columns(i):
                    M[j, k] += sd[j] * sd[k] * w[i]
        return M

    def slope(self, theta, residual, u):
        sd = self.scale(theta[:len(self.groups)])
        s = -u
        for i in range(len(self.y)):
            for j in self.columns(i):
                s[j] += sd[j] * residual[i]
        return s

    def value(self, theta, u):
        p = [1 / (1 + exp(-e)) for e in self.eta(theta, u)]
        likelihood = sum(log(q) if y == 1 else log(1 - q) for y, q in zip(self.y, p))
        return -2 * likelihood + sum(x * x for x in u) + log(det(self.information(theta, [q * (1 - q) for q in p])))

    def mode(self, theta):
        u = self.u.copy()
        for _ in range(60):
            p = [1 / (1 + exp(-e)) for e in self.eta(theta, u)]
            step = lu_solve(self.information(theta, [q * (1 - q) for q in p]), self.slope(theta, [y - q for y, q in zip(self.y, p)], u))
            u += step
            if max(abs(x) for x in step) < mpf(10)**-30:
                break
        return u

    def at(self, theta):
        self.u = self.mode(theta)
        return self.value(theta, self.u)

    def hold(self, theta):
        u = self.mode(theta)
        self.held = [1 / (1 + exp(-e)) for e in self.eta(theta, u)]
        self.held_eta = self.eta(theta, u)

    def one_step(self, theta):
        w = [p * (1 - p) for p in self.held]
        eta = self.eta(theta, matrix(self.q, 1))
        working = [w[i] * (self.held_eta[i] - eta[i]) + self.y[i] - self.held[i] for i in range(len(self.y))]
        return self.value(theta, lu_solve(self.information(theta, w), self.slope(theta, working, matrix(self.q, 1))))


def derivatives(f, x, h=mpf(10)**-8):
    n = len(x)
    gradient, hessian = matrix(n, 1), matrix(n, n)
    at = lambda *moves: f([x[i] + sum(d for j, d in moves if j == i) for i in range(n)])
    middle = f(x)
    for i in range(n):
        up, down = at((i, h)), at((i, -h))
        gradient[i] = (up - down) / (2 * h)
        hessian[i, i] = (up - 2 * middle + down) / h**2
        for j in range(i):
            hessian[i, j] = hessian[j, i] = (at((i, h), (j, h)) - at((i, h), (j, -h)) - at((i, -h), (j, h)) + at((i, -h), (j, -h))) / (4 * h * h)
    return gradient, hessian


def fit(y, cell, groups, start):
    criterion = Criterion(y, cell, groups)
    x = [mpf(s) for s in start]
    for _ in range(9):
        gradient, hessian = derivatives(criterion.at, x)
        step = lu_solve(hessian, gradient)
        x = [a - b for a, b in zip(x, step)]
        if max(abs(s) for s in step) < mpf(10)**-13:
            break
    value = criterion.at(x)
    criterion.hold(x)
    covariance = 2 * derivatives(criterion.one_step, x)[1]**-1
    k = len(groups)
    return value, x[:k], x[k:], covariance[k:, k:]


def report(name, y, cell, groups, start, start_null):
    value, sd, means, C = fit(y, cell, groups, start)
    null = fit(y, [0] * len(y), groups, start_null)[0]
    for k, s in enumerate(sd):
        show('%s.sd%d' % (name, k), abs(s))
    for i in range(len(means)):
        b = means[i] - (means[0] if i else 0)
        se = sqrt(C[i, i] + (C[0, 0] - 2 * C[i, 0] if i else 0))
        show('%s.b%d' % (name, i), b)
        show('%s.se%d' % (name, i), se)
        show('%s.p%d' % (name, i), erfc(abs(b / se) / sqrt(2)))
    show(name + '.logLik', -value / 2)
    show(name + '.null', -null / 2)
    show(name + '.chi', null - value)
    show(name + '.p', gammainc(mpf(len(means) - 1) / 2, (null - value) / 2, inf, regularized=True))


y = [1, 0, 1, 1, 0, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 0, 0, 1,
     1, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1]
rows = range(60)
report('both', y, [i % 3 for i in rows], [[i // 12 for i in rows], [i // 3 % 4 for i in rows]], [0.89, 0.62, 0.5, 0, 0.76], [0.85, 0.6, 0.4])
report('people', y, [i % 3 for i in rows], [[i // 12 for i in rows]], [0.8, 0.5, 0, 0.7], [0.8, 0.4])

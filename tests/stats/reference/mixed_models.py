# /usr/bin/python3 tests/stats/reference/mixed_models.py (numpy, scipy 1.10): the numbers of tests/stats/mixed_model_test.cpp. Dense
# matrices: V = sum of phi_k V_k, Newton's method on the restricted (or full) likelihood with its exact derivatives, Satterthwaite's
# degrees of freedom by the delta method from the observed information. lmer(..., REML = TRUE) with lmerTest agrees to 1e-5.
import numpy as np
from scipy import stats


def show(name, value):
    print('%s\t%.15g' % (name, value))


def indicator(levels):
    names = list(dict.fromkeys(levels))
    return np.array([[1.0 if level == name else 0.0 for name in names] for level in levels])


def treatment(levels):
    Z = indicator(levels)
    Z[:, 0] = 1
    return Z


class Model:
    """parts: the matrices V_k, the residual's last; start: their (co)variances."""

    def __init__(self, y, X, parts, start, reml=True):
        y, X = np.array(y, float), np.array(X, float)
        n, p = X.shape
        parts = list(parts) + [np.eye(n)]
        phi = np.array(start, float)
        for step in range(200):
            W = np.linalg.inv(sum(f * V for f, V in zip(phi, parts)))
            self.C = np.linalg.inv(X.T @ W @ X)
            P = W - W @ X @ self.C @ X.T @ W
            Py = P @ y
            T = P if reml else W
            TV = [T @ V for V in parts]
            gradient = np.array([np.trace(t) - Py @ V @ Py for t, V in zip(TV, parts)])
            hessian = np.array([[2 * Py @ A @ P @ B @ Py - np.sum(tA * tB.T) for B, tB in zip(parts, TV)] for A, tA in zip(parts, TV)])
            expected = np.array([[np.sum(tA * tB.T) for tB in TV] for tA in TV])
            # Fisher scoring far away, Newton's method close by.
            change = np.linalg.solve(hessian if step > 30 else expected, gradient)
            fraction = 1.0
            while np.any((phi - fraction * change)[[k for k, V in enumerate(parts) if np.all(np.diag(V) >= 0) and V.trace() > 0]] <= 0):
                fraction /= 2
            phi = phi - fraction * change
        assert np.all(abs(change) < 1e-10 * abs(phi).max()), change
        self.phi, self.b = phi, self.C @ X.T @ W @ y
        self.criterion = -np.linalg.slogdet(W)[1] + y @ Py + (n - p if reml else n) * np.log(2 * np.pi)
        if reml:
            self.criterion -= np.linalg.slogdet(self.C)[1]
        self.A = 2 * np.linalg.inv(hessian)
        self.dC = [self.C @ X.T @ W @ V @ W @ X @ self.C for V in parts]
        self.X = X

    def df(self, l):
        g = np.array([l @ d @ l for d in self.dC])
        return 2 * (l @ self.C @ l)**2 / (g @ self.A @ g)

    def contrast(self, name, l, level=0.95):
        l = np.array(l, float)
        se, df, b = np.sqrt(l @ self.C @ l), self.df(l), l @ self.b
        t = b / se
        show(name + '.b', b)
        show(name + '.se', se)
        show(name + '.df', df)
        show(name + '.t', t)
        show(name + '.p', 2 * stats.t.sf(abs(t), df))
        reach = stats.t.ppf((1 + level) / 2, df) * se
        show(name + '.low', b - reach)
        show(name + '.high', b + reach)

    def effect(self, name):
        """All but the intercept, as sequential (type I) contrasts, as lmerTest has them (Fai and Cornelius 1996)."""
        U = np.linalg.cholesky(self.X.T @ self.X).T
        L = (U / np.diag(U)[:, None])[1:]
        values, vectors = np.linalg.eigh(L @ self.C @ L.T)
        Q = vectors.T @ L
        F = sum((q @ self.b)**2 / v for q, v in zip(Q, values)) / len(values)
        nu = np.array([self.df(q) for q in Q])
        if nu.max() - nu.min() < 1e-8:
            df2 = nu[0]
        elif nu.min() <= 2:
            df2 = 2
        else:
            e = sum(nu / (nu - 2))
            df2 = 2 * e / (e - len(nu))
        show(name + '.F', F)
        show(name + '.df2', df2)
        show(name + '.pF', stats.f.sf(F, len(values), df2))


def intercepts(levels):
    Z = indicator(levels)
    return Z @ Z.T


# --- Eighteen ratings of six people, three conditions, two fabrics, with gaps.
y = [4.1, 6.1, 6.0, 3.2, 5.5, 5.8, 4.4, 6.9, 6.6, 5.4, 5.2, 7.9, 5.3, 6.6, 5.0, 7.3, 7.0, 4.2]
c = [1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 2, 3, 1, 2, 3, 1]
p = [1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 5, 5, 6, 6, 6, 2]
f = [1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 1, 2, 1, 2, 1]
for name, reml in (('reml', True), ('ml', False)):
    m = Model(y, treatment(c), [intercepts(p), intercepts(f)], [0.2, 0.02, 0.4], reml)
    show(name + '.criterion', m.criterion)
    for k, part in enumerate(('people', 'fabrics', 'residual')):
        show(name + '.' + part, m.phi[k])
    for k in range(3):
        m.contrast('%s.%d' % (name, k), np.eye(3)[k], 0.95 if reml else 0.9)
    m.contrast(name + '.32', [0, -1, 1], 0.9)
    m.effect(name)
# The second set: the fabrics' variance is 0, and the model the one without them.
y = [4.1, 5.2, 6.0, 3.9, 5.5, 6.3, 5.0, 5.9, 7.1, 4.4, 4.9, 6.8, 5.6, 6.1, 5.3, 6.6, 7.4, 4.2]
m = Model(y, treatment(c), [intercepts(p)], [0.2, 0.1])
show('zero.criterion', m.criterion)
show('zero.people', m.phi[0])
show('zero.residual', m.phi[1])
m.effect('zero')

# --- A slope for each of six people (intercept and slope correlated), and a crossed group of three.
days = [0, 1, 2, 3, 4] * 6
person = [i // 5 for i in range(30)]
batch = [(2 * i + i // 5) % 3 for i in range(30)]
reaction = [251, 258, 256, 279, 281, 222, 232, 227, 245, 262, 203, 210, 219, 216, 232, 321, 300, 308, 315, 330, 287, 285, 311, 320, 345,
            215, 235, 241, 243, 260]
keep = [i for i in range(30) if i not in (7, 23)]
days, person, batch, reaction = ([v[i] for i in keep] for v in (days, person, batch, reaction))
Z, D = indicator(person), np.diag(np.array(days, float))
G00, G01, G11 = Z @ Z.T, Z @ Z.T @ D + D @ Z @ Z.T, D @ Z @ Z.T @ D
X = np.column_stack([np.ones(len(days)), days])
for name, reml in (('slope', True), ('slopeMl', False)):
    m = Model(reaction, X, [G00, G01, G11, intercepts(batch)], [1400.0, 10.0, 20.0, 5.0, 40.0], reml)
    show(name + '.criterion', m.criterion)
    show(name + '.v0', m.phi[0])
    show(name + '.v1', m.phi[2])
    show(name + '.r', m.phi[1] / np.sqrt(m.phi[0] * m.phi[2]))
    show(name + '.batch', m.phi[3])
    show(name + '.residual', m.phi[4])
    m.contrast(name + '.0', [1, 0])
    m.contrast(name + '.1', [0, 1])

# --- A crossed study by formula: 6 participants, 4 fabrics, 3 conditions, two answers missing.
rows = [(p, f, c) for p in range(6) for f in range(4) for c in range(3)]
y = []
for p, f, c in rows:
    value = (5 + 0.9 * np.sin(3 * p + 1) + 0.8 * np.cos(5 * f) + 0.6 * c + 0.8 * np.sin(7 * p + 11 * c) + 0.7 * np.sin(13 * f + 5 * c + 2)
             + 0.8 * np.sin(17 * p + 23 * f + 31 * c))
    y.append(round(10 * value) / 10)
keep = [i for i in range(72) if i not in (10, 41)]
rows, y = [rows[i] for i in keep], [y[i] for i in keep]
person, fabric, condition = ([r[k] for r in rows] for k in range(3))
parts = [intercepts(person), intercepts(fabric), intercepts(list(zip(person, condition))), intercepts(list(zip(fabric, condition)))]
m = Model(y, treatment(condition), parts, [0.5, 0.3, 0.3, 0.2, 0.4])
show('study.criterion', m.criterion)
for k, name in enumerate(('participant', 'fabric', 'participantCondition', 'fabricCondition', 'residual')):
    show('study.' + name, m.phi[k])
for k in range(3):
    m.contrast('study.%d' % k, np.eye(3)[k])
m.contrast('study.21', [0, -1, 1])
m.effect('study')

# --- Two fabrics: a contrast with 2 or fewer degrees of freedom gives F 2 of them.
rows = [(p, f, c) for p in range(4) for f in range(2) for c in range(3)]
y = [round(10 * (5 + 0.3 * np.sin(3 * p + 1) + 5 * f + 1.2 * np.sin(4 * f + 5 * c + 2) + 0.4 * np.sin(17 * p + 23 * f + 31 * c))) / 10
     for p, f, c in rows]
for missing in (7, 8):
    name = 'few%d' % missing
    kept = [i for i in range(24) if i != missing]
    person, fabric, pair, condition = ([rows[i][0] for i in kept], [rows[i][1] for i in kept], [rows[i][1:] for i in kept],
                                       [rows[i][2] for i in kept])
    m = Model([y[i] for i in kept], treatment(condition), [intercepts(person), intercepts(fabric), intercepts(pair)], [0.1, 2.0, 2.0, 0.1])
    show(name + '.people', m.phi[0])
    show(name + '.fabrics', m.phi[1])
    show(name + '.pairs', m.phi[2])
    m.contrast(name + '.1', [0, 1, 0])
    m.effect(name)

# --- The mean of a participant x fabric table (tests/stats/crossed_mean_test.cpp). Complete: mean squares give the same.
y = [1.2, 0.4, -0.3, 2.1, 1.9, 0.2, 0.3, 0.8, -1.1, 1.6, 0.1, 0.7]
for name, kept in (('crossed', range(12)), ('crossedGap', [i for i in range(12) if i not in (4, 11)])):
    m = Model([y[i] for i in kept], np.ones((len(kept), 1)), [intercepts([i // 3 for i in kept]), intercepts([i % 3 for i in kept])],
              [0.3, 0.5, 0.4])
    m.contrast(name, [1])
    m.contrast(name, [1], 0.9)

"""Reference numbers of tests/stats/ordinal_mixed_model_test.cpp: the ordinal mixed model by scipy's optimiser, with second
differences of the criterion at the exact mode. Debian 12: /usr/bin/python3 tests/stats/reference/ordinal_mixed_model.py

R's ordinal::clmm (2022.11-16) gives the same estimates and log likelihoods. Its standard errors of these small fits are
wrong by up to 2.5 %: it takes second differences with a step of 1e-4, where rounding of the mode is felt.
"""
import numpy as np
from scipy.optimize import minimize
from scipy.special import expit, logit

RATINGS = np.array([int(x) for x in "435646557326567633566757232423536432656574653256244312455325"])
ROWS = np.arange(60)
CONDITION, PERSON, FABRIC = ROWS % 3, ROWS // 12, ROWS // 3 % 4


class Model:
    def __init__(self, rows, groups, with_condition=True):
        self.y = RATINGS[rows]
        self.condition = CONDITION[rows]
        self.effects = 2 if with_condition else 0
        self.groups = len(groups)
        self.z = [np.eye(g.max() + 1)[g[rows]] for g in groups]
        self.u = np.zeros(sum(z.shape[1] for z in self.z))

    def criterion(self, x):
        """- log likelihood; x: SDs, thresholds, effects."""
        sds, cuts, effects = np.split(x, [self.groups, self.groups + 6])
        if np.any(np.diff(cuts) <= 0) or np.abs(x).max() > 20:
            return 1e4  # no place of the likelihood
        cuts = np.concatenate([[-np.inf], cuts, [np.inf]])
        fixed = np.concatenate([[0], effects, np.zeros(2 - self.effects)])[self.condition]
        z = np.hstack([sd * z for sd, z in zip(sds, self.z)]) if self.groups else np.zeros((len(self.y), 0))
        for _ in range(60):
            eta = fixed + z @ self.u
            above, below = expit(cuts[self.y] - eta), expit(cuts[self.y - 1] - eta)
            weight = above * (1 - above) + below * (1 - below)
            information = z.T @ (weight[:, None] * z) + np.eye(len(self.u))
            slope = z.T @ (above + below - 1) - self.u
            step = np.linalg.solve(information, slope)
            if step @ slope < 1e-26:
                break
            self.u = self.u + step
        return -np.log(above - below).sum() + self.u @ self.u / 2 + np.linalg.slogdet(information)[1] / 2

    def start(self):
        shares = np.array([(self.y <= j).mean() for j in range(1, 7)])
        return np.concatenate([np.full(self.groups, 0.5), logit(shares), np.zeros(self.effects)])


def hessian(f, x, h):
    n = len(x)
    e = np.eye(n) * h
    return np.array([[(f(x + e[a] + e[b]) - f(x + e[a] - e[b]) - f(x - e[a] + e[b]) + f(x - e[a] - e[b])) / (4 * h * h)
                      for b in range(n)] for a in range(n)])


def show(title, model):
    x = minimize(model.criterion, model.start(), method="BFGS", options={"gtol": 1e-9}).x
    for _ in range(2):  # Newton steps: BFGS stops at about 1e-6
        h = 1e-3
        slope = np.array([(model.criterion(x + e) - model.criterion(x - e)) / (2 * h) for e in np.eye(len(x)) * h])
        x = x - np.linalg.solve(hessian(model.criterion, x, h), slope)
    coarse, fine = hessian(model.criterion, x, 4e-3), hessian(model.criterion, x, 2e-3)
    se = np.sqrt(np.diag(np.linalg.inv((4 * fine - coarse) / 3)))
    print(title, "\n  log likelihood %.12f" % -model.criterion(x))
    print("  SDs", *("%.9f" % v for v in np.abs(x[:model.groups])))
    print("  thresholds", *("%.9f" % v for v in x[model.groups:model.groups + 6]))
    print("  their se", *("%.8f" % v for v in se[model.groups:model.groups + 6]))
    print("  effects, se", *("%.9f %.8f" % pair for pair in zip(x[model.groups + 6:], se[model.groups + 6:])))


everything = ROWS
present = np.setdiff1d(ROWS, [0, 6, 7, 19, 32, 33, 34, 49])
show("people and fabrics", Model(everything, [PERSON, FABRIC]))
show("without condition", Model(everything, [PERSON, FABRIC], False))
show("people", Model(everything, [PERSON]))
show("no groups", Model(everything, []))
show("missing cells", Model(present, [PERSON, FABRIC]))

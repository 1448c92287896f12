# Psychometric functions for psychometric_function_test.cpp: Rscript psychometric_function.R
options(digits = 12)
link <- function(m, lapse) structure(list(
  linkfun = function(mu) qnorm(pmin(pmax((mu - 1 / m) / (1 - 1 / m - lapse), 1e-12), 1 - 1e-12)),
  linkinv = function(eta) 1 / m + (1 - 1 / m - lapse) * pnorm(eta),
  mu.eta = function(eta) (1 - 1 / m - lapse) * dnorm(eta),
  valideta = function(eta) TRUE, name = "mafc"), class = "link-glm")

fit <- function(x, k, n, m, lapse, start, level = NA) {
  g <- glm(cbind(k, n - k) ~ x, binomial(link(m, lapse)), start = start, control = list(epsilon = 1e-15, maxit = 500))
  b <- coef(g); v <- vcov(g)
  mu <- unname(-b[1] / b[2]); sigma <- unname(1 / b[2])
  dmu <- c(-1 / b[2], b[1] / b[2]^2); dsigma <- c(0, -1 / b[2]^2)
  print(c(mu = mu, se = sqrt(drop(t(dmu) %*% v %*% dmu)), sigma = sigma, se = sqrt(drop(t(dsigma) %*% v %*% dsigma))))
  print(c(logLik = logLik(g), deviance = deviance(g), df = df.residual(g),
          p = pchisq(deviance(g), df.residual(g), lower.tail = FALSE)))
  # profile of mu: the slope is maximised at each mu
  ll <- function(b0, b1) { p <- 1 / m + (1 - 1 / m - lapse) * pnorm(b0 + b1 * x); sum(dbinom(k, n, p, log = TRUE)) }
  drop.mu <- function(at) 2 * (as.numeric(logLik(g)) - optimize(function(b1) ll(-b1 * at, b1), b[2] * c(0.05, 5), maximum = TRUE, tol = 1e-12)$objective)
  drop.sigma <- function(at) 2 * (as.numeric(logLik(g)) - optimize(function(c) ll(-c / at, 1 / at), mu + c(-1, 1), maximum = TRUE, tol = 1e-12)$objective)
  end <- function(f, from, to) uniroot(function(z) f(z) - qchisq(.95, 1), c(from, to), tol = 1e-11)$root
  s <- sqrt(drop(t(dmu) %*% v %*% dmu)); r <- sqrt(drop(t(dsigma) %*% v %*% dsigma))
  print(c(mu = c(end(drop.mu, mu - 6 * s, mu), end(drop.mu, mu, mu + 6 * s)),
          sigma = c(end(drop.sigma, sigma / 4, sigma), end(drop.sigma, sigma, sigma + 8 * r))))
  if (!is.na(level)) {
    z <- qnorm((level - 1 / m) / (1 - 1 / m - lapse))
    d <- c(-1 / b[2], -(z - b[1]) / b[2]^2)
    print(c(threshold = unname((z - b[1]) / b[2]), se = sqrt(drop(t(d) %*% v %*% d))))
  }
}
x <- c(0.5, 1, 1.5, 2, 2.5, 3); n <- c(40, 40, 40, 40, 40, 40)
cat("## 3 alternatives, no lapse\n")
fit(x, c(14, 18, 22, 31, 37, 40), n, 3, 0, c(-3, 2), 0.75)
cat("## 2 alternatives, lapse 0.02\n")
fit(x, c(22, 23, 30, 33, 38, 39), n, 2, 0.02, c(-3, 2))
cat("## 3 alternatives, lapse estimated between 0 and 0.1\n")
k <- c(14, 15, 24, 34, 38, 38)
minus <- function(t) { p <- 1 / 3 + (2 / 3 - t[3]) * pnorm((x - t[1]) / t[2]); -sum(dbinom(k, n, p, log = TRUE)) }
o <- optim(c(1.6, 0.5, 0.03), minus, method = "L-BFGS-B", lower = c(0, 0.05, 0), upper = c(4, 5, 0.1),
           control = list(factr = 1, pgtol = 0, maxit = 10000))
o <- optim(o$par, minus, control = list(reltol = 1e-16, maxit = 20000, parscale = c(1, 1, 0.05)))
p <- 1 / 3 + (2 / 3 - o$par[3]) * pnorm((x - o$par[1]) / o$par[2])
d <- cbind((2 / 3 - o$par[3]) * dnorm((x - o$par[1]) / o$par[2]) * cbind(-1, -(x - o$par[1]) / o$par[2]) / o$par[2],
           -pnorm((x - o$par[1]) / o$par[2]))
print(c(o$par, logLik = -o$value)); print(sqrt(diag(solve(t(d) %*% (d * n / (p * (1 - p)))))))

# Rscript tests/stats/reference/t_tests.R: the numbers of tests/stats/t_tests_test.cpp.
show <- function(name, value) cat(sprintf("%s\t%.15g\n", name, value))
x <- c(5.1, 4.3, 6.2, 5.9, 4.8, 7.0, 5.5)
y <- c(4.6, 4.4, 5.0, 5.2, 4.9, 5.8, 5.6)
z <- c(6.1, 5.2, 7.4, 4.9, 6.6)

# t.test, with the logarithm of p and Hedges' correction J(m) = gamma(m/2) / (sqrt(m/2) gamma((m - 1)/2)).
report <- function(name, test, mu, alternative) {
  t <- unname(test$statistic)
  df <- unname(test$parameter)
  show(paste0(name, ".t"), t)
  show(paste0(name, ".df"), df)
  show(paste0(name, ".se"), test$stderr)
  show(paste0(name, ".p"), test$p.value)
  logP <- switch(alternative, two.sided = log(2) + pt(-abs(t), df, log.p = TRUE), less = pt(t, df, log.p = TRUE),
                 greater = pt(t, df, lower.tail = FALSE, log.p = TRUE))
  show(paste0(name, ".logP"), logP)
  show(paste0(name, ".low"), test$conf.int[1])
  show(paste0(name, ".high"), test$conf.int[2])
}
J <- function(m) exp(lgamma(m / 2) - lgamma((m - 1) / 2)) / sqrt(m / 2)

options <- list(list("two.sided", 0.95, 0.2), list("less", 0.99, 0.2), list("greater", 0.9, 0.2))
for (o in options) {
  alternative <- o[[1]]; level <- o[[2]]; mu <- o[[3]]
  report(paste0("one.", alternative), t.test(x, mu = 5 + mu, alternative = alternative, conf.level = level), 5 + mu, alternative)
  report(paste0("paired.", alternative), t.test(x, y, mu = mu, paired = TRUE, alternative = alternative, conf.level = level), mu,
         alternative)
  report(paste0("student.", alternative),
         t.test(x, z, mu = mu, var.equal = TRUE, alternative = alternative, conf.level = level), mu, alternative)
  report(paste0("welch.", alternative), t.test(x, z, mu = mu, alternative = alternative, conf.level = level), mu, alternative)
}
d <- x - y
show("one.estimate", mean(x)); show("one.sd", sd(x))
show("one.dz", (mean(x) - 5.2) / sd(x)); show("one.gz", (mean(x) - 5.2) / sd(x) * J(6))
show("paired.estimate", mean(d)); show("paired.sd", sd(d))
show("paired.dz", (mean(d) - 0.2) / sd(d)); show("paired.gz", (mean(d) - 0.2) / sd(d) * J(6))
show("paired.lakens", mean(d) / ((sd(x) + sd(y)) / 2)); show("paired.rms", mean(d) / sqrt((var(x) + var(y)) / 2))
pooled <- sqrt((6 * var(x) + 4 * var(z)) / 10)
show("student.estimate", mean(x) - mean(z)); show("student.sd", pooled)
show("student.ds", (mean(x) - mean(z)) / pooled); show("student.gs", (mean(x) - mean(z)) / pooled * J(10))
show("welch.rms", (mean(x) - mean(z)) / sqrt((var(x) + var(z)) / 2))

# Two one-sided tests at alpha: each is a t test, the interval one of level 1 - 2 alpha.
tost <- function(name, low, high, alpha, ...) {
  lower <- t.test(..., mu = low, alternative = "greater")
  upper <- t.test(..., mu = high, alternative = "less")
  none <- t.test(..., mu = 0)
  ci <- t.test(..., conf.level = 1 - 2 * alpha)$conf.int
  show(paste0(name, ".tLower"), lower$statistic); show(paste0(name, ".pLower"), lower$p.value)
  show(paste0(name, ".tUpper"), upper$statistic); show(paste0(name, ".pUpper"), upper$p.value)
  show(paste0(name, ".low"), ci[1]); show(paste0(name, ".high"), ci[2])
  show(paste0(name, ".tDifference"), none$statistic); show(paste0(name, ".pDifference"), none$p.value)
  show(paste0(name, ".df"), none$parameter); show(paste0(name, ".se"), none$stderr)
}
tost("eq.one", 4.9, 6.4, 0.05, x)
tost("eq.paired", -0.5, 1.2, 0.025, x, y, paired = TRUE)
tost("eq.student", -1.5, 1.1, 0.05, x, z, var.equal = TRUE)
tost("eq.welch", -1.5, 1.1, 0.1, x, z)
show("eq.one.dz", mean(x) / sd(x)); show("eq.paired.dz", mean(d) / sd(d))

# Rscript tests/stats/reference/tables.R: the numbers of tests/stats/tables_test.cpp that are not by hand.
show <- function(name, value) cat(sprintf("%s\t%.15g\n", name, value))

# --- Repeated measures: 7 participants, 4 conditions.
m <- matrix(c(5.1, 6.2, 4.0, 5.6, 4.4, 4.9, 3.9, 6.0, 6.6, 7.0, 5.2, 6.9, 3.1, 5.5, 4.7, 4.8, 5.0, 5.9, 5.0, 6.1, 4.2, 6.3, 4.5, 4.1,
              5.7, 5.8, 3.3, 6.6), 7, byrow = TRUE)
n <- nrow(m); k <- ncol(m)
long <- data.frame(y = c(t(m)), who = factor(rep(1:n, each = k)), what = factor(rep(1:k, n)))
a <- summary(aov(y ~ what + who, long))[[1]]
ss <- a[["Sum Sq"]]; ms <- a[["Mean Sq"]]
show("rm.ssCondition", ss[1]); show("rm.ssSubject", ss[2]); show("rm.ssError", ss[3])
show("rm.F", a[["F value"]][1]); show("rm.p", a[["Pr(>F)"]][1])
C <- t(contr.helmert(k)) / sqrt(diag(crossprod(contr.helmert(k))))
S <- C %*% var(m) %*% t(C)
gg <- sum(diag(S))^2 / ((k - 1) * sum(S^2))
hf <- (n * (k - 1) * gg - 2) / ((k - 1) * (n - 1 - (k - 1) * gg))
spherical <- anova(lm(m ~ 1), X = ~1, test = "Spherical")
show("rm.gg", gg); show("rm.hf", hf)
show("rm.pGg", pf(a[["F value"]][1], gg * (k - 1), gg * (k - 1) * (n - 1), lower.tail = FALSE))
show("rm.pHf", pf(a[["F value"]][1], min(1, hf) * (k - 1), min(1, hf) * (k - 1) * (n - 1), lower.tail = FALSE))
stopifnot(abs(spherical[["G-G Pr"]][1] - pf(a[["F value"]][1], gg * 3, gg * 18, lower.tail = FALSE)) < 1e-9)
show("rm.etaPartial", ss[1] / (ss[1] + ss[3])); show("rm.etaGeneral", ss[1] / sum(ss))
# Mauchly (mauchly.test has W); rho and the second term of Box (1949) for p = k - 1 contrasts.
p <- k - 1
w <- unname(mauchly.test(lm(m ~ 1), X = ~1)$statistic)
rho <- 1 - (2 * p^2 + p + 2) / (6 * p * (n - 1))
chi <- -(n - 1) * rho * log(w); df <- p * (p + 1) / 2 - 1
second <- (p + 2) * (p - 1) * (p - 2) * (2 * p^3 + 6 * p^2 + 3 * p + 2) / (288 * ((n - 1) * p * rho)^2)
first <- pchisq(chi, df, lower.tail = FALSE)
show("mauchly.w", w); show("mauchly.chi", chi); show("mauchly.p", first)
show("mauchly.p2", first + second * (pchisq(chi, df + 4, lower.tail = FALSE) - first))
# Morey's intervals: t quantile, SD of the normalised values, sqrt(k / (k - 1)).
normalised <- m - rowMeans(m) + mean(m)
morey <- function(level) qt((1 + level) / 2, n - 1) * apply(normalised, 2, sd) / sqrt(n) * sqrt(k / (k - 1))
for (j in 1:k) { show(sprintf("morey.95.%d", j), morey(0.95)[j]); show(sprintf("morey.99.%d", j), morey(0.99)[j]) }
# Intraclass correlations of rows as targets and columns as raters (Shrout and Fleiss 1979), and of the columns as targets.
icc <- function(name, m) {
  n <- nrow(m); k <- ncol(m)
  a <- summary(aov(c(m) ~ factor(rep(1:n, k)) + factor(rep(1:k, each = n))))[[1]][["Mean Sq"]]
  b <- a[1]; j <- a[2]; e <- a[3]
  w <- (j + (n - 1) * e) / n
  show(paste0(name, ".1"), (b - w) / (b + (k - 1) * w)); show(paste0(name, ".1k"), (b - w) / b)
  show(paste0(name, ".2"), (b - e) / (b + (k - 1) * e + k * (j - e) / n)); show(paste0(name, ".2k"), (b - e) / (b + (j - e) / n))
  show(paste0(name, ".3"), (b - e) / (b + (k - 1) * e)); show(paste0(name, ".3k"), (b - e) / b)
}
icc("icc", m)
icc("iccT", t(m))

# Intervals of the correlations by psych 2.2.9; its columns 7 and 8 are the bounds.
for (level in c(0.95, 0.9)) {
  bounds <- psych::ICC(m, lmer = FALSE, alpha = 1 - level)$results
  for (type in c("ICC2", "ICC3", "ICC2k", "ICC3k")) for (side in 7:8)
    show(sprintf("icc.%g.%s.%s", level, type, names(bounds)[side]), bounds[bounds$type == type, side])
}

# --- One-way analysis of variance.
groups <- list(c(5.1, 4.9, 6.2, 5.8, 5.5), c(6.1, 6.4, 5.9, 7.0), c(4.1, 4.4, 5.2))
v <- unlist(groups); g <- factor(rep(1:3, lengths(groups)))
a <- summary(aov(v ~ g))[[1]]
show("one.ssB", a[["Sum Sq"]][1]); show("one.ssW", a[["Sum Sq"]][2]); show("one.msB", a[["Mean Sq"]][1]); show("one.msW", a[["Mean Sq"]][2])
show("one.F", a[["F value"]][1]); show("one.p", a[["Pr(>F)"]][1])
show("one.r2", summary(lm(v ~ g))$r.squared); show("one.sd", summary(lm(v ~ g))$sigma)
show("one.omega", (a[["Sum Sq"]][1] - 2 * a[["Mean Sq"]][2]) / (sum(a[["Sum Sq"]]) + a[["Mean Sq"]][2]))

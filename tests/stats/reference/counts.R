# Rscript tests/stats/reference/counts.R: the numbers of tests/stats/counts_test.cpp and tests/stats/multiplicity_test.cpp.
show <- function(name, value) cat(sprintf("%s\t%.15g\n", name, value))

# --- Binomial tests, Clopper and Pearson's interval (binom.test) and Wilson's (prop.test without its correction).
binomial <- function(name, k, n, p0, level) {
  two <- binom.test(k, n, p0, conf.level = level)
  show(paste0(name, ".greater"), binom.test(k, n, p0, "greater")$p.value)
  show(paste0(name, ".less"), binom.test(k, n, p0, "less")$p.value)
  show(paste0(name, ".two"), two$p.value)
  show(paste0(name, ".mid"), pbinom(k, n, p0, lower.tail = FALSE) + dbinom(k, n, p0) / 2)
  show(paste0(name, ".cp.low"), two$conf.int[1]); show(paste0(name, ".cp.high"), two$conf.int[2])
  wilson <- suppressWarnings(prop.test(k, n, p0, conf.level = level, correct = FALSE))$conf.int
  show(paste0(name, ".w.low"), wilson[1]); show(paste0(name, ".w.high"), wilson[2])
}
binomial("b27", 27, 70, 1 / 3, 0.95)
binomial("b15", 15, 70, 1 / 3, 0.99)
binomial("b3", 3, 7, 0.5, 0.9)

for (case in list(c(7, 20, 0.2), c(0, 10, 0.3), c(50, 100, 0.5), c(10, 30, 0.5), c(9, 12, 0.6), c(20, 21, 0.9)))
  show(sprintf("two.%d.%d", case[1], case[2]), binom.test(case[1], case[2], case[3])$p.value)

# --- McNemar's test.
mcnemar <- function(name, b, c) {
  m <- matrix(c(10, c, b, 20), 2)
  plain <- mcnemar.test(m, correct = FALSE); corrected <- mcnemar.test(m)
  show(paste0(name, ".chi"), plain$statistic); show(paste0(name, ".p"), plain$p.value)
  show(paste0(name, ".chic"), corrected$statistic); show(paste0(name, ".pc"), corrected$p.value)
  show(paste0(name, ".exact"), binom.test(b, b + c)$p.value)
  show(paste0(name, ".mid"), binom.test(b, b + c)$p.value - dbinom(b, b + c, 0.5))
}
mcnemar("m", 12, 5)

# --- Adjusted p values; the missing one is no member of the family.
p <- c(0.012, 0.04, NA, 0.0009, 0.04, 0.31, 0.02, 0.86, 0.0051)
for (method in c("holm", "hochberg", "bonferroni", "BH", "BY")) {
  adjusted <- p.adjust(p, method)
  for (i in seq_along(p)) if (!is.na(p[i])) show(sprintf("%s.%d", method, i), adjusted[i])
}
# A family of three in which the step-up methods pull the second value down to the third.
for (method in c("holm", "hochberg", "BH")) for (i in 1:3) show(sprintf("three.%s.%d", method, i), p.adjust(c(0.03, 0.02, 0.031), method)[i])

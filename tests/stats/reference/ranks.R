# Rscript tests/stats/reference/ranks.R: the numbers of tests/stats/ranks_test.cpp. Exact p by going through all signs or orders.
show <- function(name, value) cat(sprintf("%s\t%.15g\n", name, value))

# --- Wilcoxon's signed rank, both ways to treat zeros; differences in tenths, so that ties are ties.
d <- c(3, -1, 5, 5, 0, 2, -4, 6, 1, 9, -2, 0)
signedRank <- function(name, d, pratt) {
  if (!pratt) d <- d[d != 0]
  r <- rank(abs(d))
  keep <- d != 0
  r <- r[keep]; s <- d[keep] > 0
  v <- sum(r[s])
  n <- length(r)
  all <- as.matrix(expand.grid(rep(list(0:1), n))) %*% r
  p <- c(two.sided = mean(abs(all - sum(r) / 2) >= abs(v - sum(r) / 2) - 1e-9), less = mean(all <= v + 1e-9),
         greater = mean(all >= v - 1e-9))
  sd <- sqrt(sum(r^2)) / 2
  z <- (v - sum(r) / 2) / sd
  corrected <- c(two.sided = (abs(v - sum(r) / 2) - 0.5) * sign(v - sum(r) / 2) / sd, less = (v - sum(r) / 2 + 0.5) / sd,
                 greater = (v - sum(r) / 2 - 0.5) / sd)
  show(paste0(name, ".v"), v); show(paste0(name, ".z"), z); show(paste0(name, ".biserial"), (2 * v - sum(r)) / sum(r))
  for (a in names(p)) {
    normal <- function(z) switch(a, two.sided = 2 * pnorm(-abs(z)), less = pnorm(z), greater = pnorm(z, lower.tail = FALSE))
    show(paste0(name, ".", a, ".p"), p[[a]])
    show(paste0(name, ".", a, ".normal"), normal(z))
    show(paste0(name, ".", a, ".zc"), corrected[[a]])
    show(paste0(name, ".", a, ".normalc"), normal(corrected[[a]]))
  }
}
signedRank("wilcox", d, FALSE)
signedRank("pratt", d, TRUE)
walsh <- outer(d / 10, d / 10, "+") / 2
show("hodges.even", median(walsh[upper.tri(walsh, TRUE)]))       # 78 averages
walsh <- outer(d[1:5] / 10, d[1:5] / 10, "+") / 2
show("hodges.odd", median(walsh[upper.tri(walsh, TRUE)]))        # 15 averages
# wilcox.test agrees where it can: no zeros, the corrected normal approximation.
test <- suppressWarnings(wilcox.test(d[d != 0], exact = FALSE, correct = TRUE))
stopifnot(abs(test$p.value - 2 * pnorm(-(abs(test$statistic - 27.5) - 0.5) / sqrt(sum(rank(abs(d[d != 0]))^2) / 4))) < 1e-12)

# --- Sign flips over all 2^n signs.
flips <- function(name, d) {
  all <- (2 * as.matrix(expand.grid(rep(list(0:1), length(d)))) - 1) %*% abs(d)
  s <- sum(d)
  show(paste0(name, ".two.sided"), mean(abs(all) >= abs(s) - 1e-9))
  show(paste0(name, ".less"), mean(all <= s + 1e-9)); show(paste0(name, ".greater"), mean(all >= s - 1e-9))
  show(paste0(name, ".mean"), mean(d))
}
flips("flips", d / 10)
flips("negative", c(-7, -3, 2, -5, 1, -6) / 10)

# --- Friedman's test with ties, and Iman and Davenport's F.
m <- matrix(c(5.1, 6.2, 4.0, 5.1, 4.4, 4.4, 3.9, 6.0, 6.6, 7.0, 5.2, 6.6, 3.1, 5.5, 4.7, 4.9, 5.0, 5.9, 5.0, 6.1, 4.2, 6.3, 4.5, 4.1),
            6, byrow = TRUE)
f <- friedman.test(m)
n <- nrow(m); k <- ncol(m)
show("friedman.q", f$statistic); show("friedman.p", f$p.value)
show("friedman.logp", pchisq(f$statistic, k - 1, lower.tail = FALSE, log.p = TRUE))
show("friedman.w", f$statistic / (n * (k - 1)))
F <- (n - 1) * f$statistic / (n * (k - 1) - f$statistic)
show("friedman.F", F); show("friedman.Fp", pf(F, k - 1, (k - 1) * (n - 1), lower.tail = FALSE))
# Exact: the statistic rises with the sum of squared distances of the rank sums.
permutations <- rbind(1:3, c(1, 3, 2), c(2, 1, 3), c(2, 3, 1), c(3, 1, 2), 3:1)
orders <- function(r) unique(matrix(r[permutations], 6))
exactFriedman <- function(name, m) {
  ranks <- t(apply(m, 1, rank))
  spread <- function(s) sum((s - nrow(m) * 2)^2)
  sums <- matrix(0, 1, 3)
  for (i in seq_len(nrow(m))) {
    o <- orders(ranks[i, ])
    sums <- do.call(rbind, lapply(seq_len(nrow(o)), function(j) sweep(sums, 2, o[j, ], "+")))
  }
  # every block's orders are equally likely, so that all rows are
  show(name, mean(apply(sums, 1, spread) >= spread(colSums(ranks)) - 1e-9))
}
exactFriedman("exact.ties", m[, 1:3])
exactFriedman("exact.plain", matrix(c(1, 2, 3, 2, 1, 3, 1, 3, 2, 1, 2, 3, 3, 2, 1), 5, byrow = TRUE))

# --- Cochran's Q (package-free: the formula of Cochran 1950).
b <- matrix(c(1, 1, 0, 1, 0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 1, 0), 7, byrow = TRUE)
k <- ncol(b)
q <- (k - 1) * (k * sum(colSums(b)^2) - sum(b)^2) / (k * sum(b) - sum(rowSums(b)^2))
show("cochran.q", q); show("cochran.p", pchisq(q, k - 1, lower.tail = FALSE))

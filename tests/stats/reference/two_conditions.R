# The difference of two conditions by lmerTest's model of both alone, for calibration_test.cpp.
# Rscript two_conditions.R prints for each seed: the variances at zero, the answers, estimate, standard error, degrees of freedom.
suppressMessages(library(lmerTest))
participants <- 4
fabrics <- 3
for (seed in 1:40) {
  set.seed(seed)
  d <- expand.grid(f = 1:fabrics, p = 1:participants, c = 1:2)
  sp <- c(0, 1, 0, 1, 1)[seed %% 5 + 1]
  sf <- c(0, 0, 1, 1, 1)[seed %% 5 + 1]
  both <- c(.7, 0)[seed %% 2 + 1]
  d$y <- round(rnorm(nrow(d)) + rnorm(participants * 2, 0, sp)[d$p + participants * (d$c - 1)] +
    rnorm(fabrics * 2, 0, sf)[d$f + fabrics * (d$c - 1)] + rnorm(participants, 0, both)[d$p] +
    rnorm(fabrics, 0, both)[d$f], 1)
  y <- d$y
  for (name in c("p", "f", "c")) d[[name]] <- factor(d[[name]])
  d$c <- relevel(d$c, "2")
  m <- suppressMessages(lmer(y ~ c + (1 | p) + (1 | f) + (1 | p:c) + (1 | f:c), d, control = lmerControl(
    optimizer = "Nelder_Mead", optCtrl = list(xtol_abs = 1e-11, ftol_abs = 1e-12, maxfun = 1e5))))
  s <- summary(m)$coefficients[2, ]
  zero <- paste(as.integer(as.data.frame(VarCorr(m))$sdcor < 1e-3), collapse = "")
  cat(sprintf("seed %d zero %s | {%s}, %.6f, %.6f, %.4f\n", seed, zero, paste(y, collapse = ", "), s[1], s[2], s[3]))
}

# Two-way analyses of variance for two_way_anova_test.cpp: Rscript two_way_anova.R (packages car and afex).
suppressMessages({library(car); library(afex)})
options(digits = 12)
afex_options(check_contrasts = TRUE)

cat("## between, unbalanced\n")
between <- data.frame(
  y = c(4.1, 5.3, 3.8, 6.2, 7.1, 5.9, 8.4, 2.9, 3.5, 6.6, 7.7, 7.2, 9.1, 8.8),
  a = factor(rep(c("x", "z"), c(7, 7))),
  b = factor(c("p", "p", "p", "q", "q", "r", "r", "p", "p", "q", "q", "q", "r", "r")))
contrasts(between$a) <- contr.sum(2)
contrasts(between$b) <- contr.sum(3)
print(Anova(lm(y ~ a * b, between), type = 2), digits = 12)
print(Anova(lm(y ~ a * b, between), type = 3), digits = 12)

cat("## between, one empty cell, type II\n")
gap <- subset(between, !(a == "z" & b == "r"))
full <- lm(y ~ a * b, gap)
print(anova(lm(y ~ b + a, gap), full), digits = 12)
print(anova(lm(y ~ b, gap), lm(y ~ b + a, gap)), digits = 12)
print(anova(lm(y ~ a, gap), lm(y ~ a + b, gap)), digits = 12)
print(c(rss = deviance(full), df = df.residual(full)))

show <- function(fit) {
  print(fit$anova_table, digits = 12)
  s <- summary(fit$Anova, multivariate = FALSE)
  print(unclass(s$univariate.tests), digits = 12)
  print(s$pval.adjustments, digits = 12)
  print(s$sphericity.tests, digits = 12)
}

cat("## within x within\n")
within <- data.frame(
  who = factor(rep(1:6, each = 6)), a = factor(rep(rep(c("a1", "a2"), each = 3), 6)), b = factor(rep(c("b1", "b2", "b3"), 12)),
  y = c(5.1, 6.2, 7.4, 4.9, 6.6, 8.9, 3.2, 4.9, 5.1, 4.1, 4.4, 7.0, 6.0, 6.1, 8.2, 6.3, 7.9, 8.1,
        2.9, 3.6, 6.1, 3.3, 5.2, 7.7, 5.5, 5.2, 6.9, 4.4, 6.1, 7.2, 4.4, 6.8, 7.0, 5.9, 6.5, 9.6))
show(aov_ez("who", "y", within, within = c("a", "b"), anova_table = list(correction = "none", es = c("ges", "pes"))))

cat("## between x within, unequal groups\n")
mixed <- data.frame(
  who = factor(rep(1:7, each = 4)), g = factor(rep(c("g1", "g2"), c(12, 16))), c = factor(rep(c("c1", "c2", "c3", "c4"), 7)),
  y = c(5.1, 6.2, 7.4, 6.0, 3.2, 4.9, 5.1, 4.1, 6.0, 6.1, 8.2, 6.3, 2.9, 3.6, 6.1, 3.3, 5.5, 5.2, 6.9, 4.4, 4.4, 6.8, 7.0, 5.9,
        3.9, 4.2, 6.6, 6.1))
for (type in 2:3)
  show(aov_ez("who", "y", mixed, between = "g", within = "c", type = type,
              anova_table = list(correction = "none", es = c("ges", "pes"))))

# Numbers of analyse_families_test.cpp: Rscript analyse_families.R (packages lme4, lmerTest and ordinal).
suppressMessages({library(lme4); library(lmerTest)})
options(digits = 12)
rows <- expand.grid(c = 0:2, f = 0:4, p = 0:7)
rows$value <- with(rows, (p * 7 + f * 5 + c * 4 + p * f * 11 + (p + c)^2 * 3 + f * c * (f + 1) + c * p * p * f) %% 13 / 2 + c)
rows$correct <- as.numeric(with(rows, (p * 5 + f * 3 + c * 7 + p * f * c + f * f + p * p) %% 11 + c > 4))
for (v in c("p", "f", "c")) rows[[v]] <- factor(paste0(v, rows[[v]]))
names(rows)[1:3] <- c("condition", "fabric", "participant")
tight <- lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-12, maxfun = 1e5), check.conv.singular = "ignore")

for (terms in c("(1|participant)+(1|fabric)+(1|participant:condition)+(1|fabric:condition)", "(1|participant)+(1|fabric)")) {
  m <- lmer(as.formula(paste("value ~ condition +", terms)), rows, control = tight)
  cat("##", terms, "\n")
  print(coef(summary(m)), digits = 12); print(as.data.frame(VarCorr(m))[, c("grp", "vcov")], digits = 12)
  print(c(REML = REMLcrit(m))); print(anova(m), digits = 12)
  print(contest1D(m, c(0, 1, -1)), digits = 12)
}

cat("## claims, c0 - c2\n")
wide <- merge(subset(rows, condition == "c0"), subset(rows, condition == "c2"), by = c("participant", "fabric"))
wide$d <- wide$value.x - wide$value.y
d <- lmer(d ~ 1 + (1 | participant) + (1 | fabric), wide, control = tight)
print(coef(summary(d)), digits = 12)
print(t.test(tapply(wide$d, wide$participant, mean))[c("estimate", "stderr", "parameter", "p.value")])
print(t.test(tapply(rows$correct[rows$condition == "c2"], rows$participant[rows$condition == "c2"], mean), mu = 1 / 3, alternative = "greater")$p.value)

cat("## logistic\n")
g <- glmer(correct ~ condition + (1 | participant) + (1 | fabric), rows, binomial,
           control = glmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-10, maxfun = 1e5), tolPwrss = 1e-12))
g0 <- update(g, . ~ . - condition)
print(coef(summary(g)), digits = 12); print(as.data.frame(VarCorr(g))[, c("grp", "sdcor")], digits = 12)
print(c(logLik = logLik(g), lrt = 2 * as.numeric(logLik(g) - logLik(g0))))

cat("## ordinal\n")
suppressMessages(library(ordinal))
rows$rating <- factor(floor(rows$value + 0.5))
tightOrdinal <- clmm.control(gradTol = 1e-7, maxIter = 200, maxLineIter = 200)
o <- clmm(rating ~ condition + (1 | participant) + (1 | fabric), data = rows, control = tightOrdinal)
o0 <- clmm(rating ~ 1 + (1 | participant) + (1 | fabric), data = rows, control = tightOrdinal)
print(coef(summary(o)), digits = 12); print(sapply(VarCorr(o), function(v) sqrt(v[1])), digits = 12)
print(c(logLik = logLik(o), lrt = 2 * as.numeric(logLik(o) - logLik(o0))))

# Nakagawa, Johnson and Schielzeth 2017. The residual of log odds is the variance of the standard logistic distribution.
cat("## R squared\n")
rSquared <- function(model, residual) {
  fixed <- var(as.vector(model.matrix(model) %*% fixef(model)))
  table <- as.data.frame(VarCorr(model))
  random <- sum(table$vcov[table$grp != "Residual"])
  print(c(fixed = fixed, marginal = fixed / (fixed + random + residual), conditional = (fixed + random) / (fixed + random + residual)),
        digits = 12)
}
for (terms in c("(1|participant)+(1|fabric)+(1|participant:condition)+(1|fabric:condition)", "(1|participant)+(1|fabric)")) {
  m <- lmer(as.formula(paste("value ~ condition +", terms)), rows, control = tight)
  rSquared(m, sigma(m)^2)
}
rSquared(g, pi^2 / 3)

# Bits per second by Wolpaw et al. 1998 and Tukey's jackknife; balanced integration score by Liesefeld and Janczyk 2019. Participant
# p3 has no times under c1, and the first row of c2 has no choice.
cat("## speed contrasts\n")
rows$seconds <- with(rows, 2 + (as.numeric(participant) * 3 + as.numeric(fabric) * 5 + as.numeric(condition) * 2) %% 7 / 2)
rows$seconds[rows$participant == "p3" & rows$condition == "c1"] <- NA
rows$correct[which(rows$condition == "c2")[1]] <- NA
chosen <- rows[!is.na(rows$correct), ]
bits <- function(p, m = 3) if (p <= 1 / m) 0 else log2(m) + p * log2(p) + ifelse(p < 1, (1 - p) * log2((1 - p) / (m - 1)), 0)
rate <- function(d) bits(mean(d$correct)) / mean(d$seconds, na.rm = TRUE)
meansOf <- function(x) tapply(x, list(chosen$participant, chosen$condition), mean, na.rm = TRUE)
share <- meansOf(chosen$correct); times <- meansOf(chosen$seconds); share[is.na(times)] <- NA
z <- function(x) (x - mean(x, na.rm = TRUE)) / sqrt(mean((x - mean(x, na.rm = TRUE))^2, na.rm = TRUE))
people <- levels(rows$participant)
pseudo <- sapply(levels(rows$condition), function(condition) {
  d <- chosen[chosen$condition == condition, ]; timed <- people[!is.nan(times[people, condition])]
  setNames(sapply(people, function(p) if (!p %in% timed) NA else
    length(timed) * rate(d) - (length(timed) - 1) * rate(d[d$participant != p, ])), people) })
measures <- list(bits_per_second = pseudo, bis = matrix(z(as.vector(share)) - z(as.vector(times)), 8, dimnames = dimnames(share)),
                 log_seconds = meansOf(log(chosen$seconds)))
for (name in names(measures)) {
  x <- measures[[name]][people, ]
  tests <- lapply(list(c(1, 2), c(1, 3), c(2, 3)), function(pair) t.test(x[, pair[1]] - x[, pair[2]]))
  table <- sapply(tests, function(t) c(t$estimate, df = t$parameter[[1]], low = t$conf.int[1], high = t$conf.int[2], p = t$p.value))
  cat(name, "\n"); print(rbind(table, holm = p.adjust(table["p", ], "holm")), digits = 12)
}
print(sapply(levels(rows$condition), function(condition) c(rate = rate(chosen[chosen$condition == condition, ]),
      bis = mean(measures$bis[, condition], na.rm = TRUE), ci = t.test(measures$bis[, condition])$conf.int)), digits = 12)

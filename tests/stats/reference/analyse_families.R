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
tight <- clmm.control(gradTol = 1e-7, maxIter = 200, maxLineIter = 200)
o <- clmm(rating ~ condition + (1 | participant) + (1 | fabric), data = rows, control = tight)
o0 <- clmm(rating ~ 1 + (1 | participant) + (1 | fabric), data = rows, control = tight)
print(coef(summary(o)), digits = 12); print(sapply(VarCorr(o), function(v) sqrt(v[1])), digits = 12)
print(c(logLik = logLik(o), lrt = 2 * as.numeric(logLik(o) - logLik(o0))))

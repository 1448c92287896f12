# The numbers of a report on answers.csv, computed with R 4.2.2, lme4 1.1-31, lmerTest 3.1-3, psych 2.2.9, afex 1.2-1,
# performance 0.10.2 and BayesFactor 0.9.12:
#   Rscript expected.R > expected.json
# Names and nesting are those of results.json (vis2hap.results/2) and statistics.json (vis2hap.statistics/1).
suppressMessages({ library(jsonlite); library(lme4); library(lmerTest) })

answers <- read.csv("answers.csv")
conditions <- unique(answers$condition)
fabrics <- unique(answers$fabric)
participants <- unique(answers$participant)
chance <- 1 / 3
bounds <- c(-0.5, 0.5)
pairs <- combn(conditions, 2, simplify = FALSE)
number <- function(x) unbox(unname(x))
named <- function(names, f) setNames(lapply(names, f), names)

# ---- one condition ------------------------------------------------------------------------------------------------
inCondition <- function(condition, question) {
  values <- answers[[question]][answers$condition == condition]
  values[!is.na(values)]
}
# Every test between conditions has the participant's mean over fabrics as its unit.
meansOf <- function(question) {
  means <- tapply(answers[[question]], list(answers$participant, answers$condition), mean, na.rm = TRUE)
  means[participants, conditions]
}
wilson <- function(x, n) prop.test(x, n, correct = FALSE)$conf.int[1:2]
clopperPearson <- function(x, n) binom.test(x, n)$conf.int[1:2]
exactP <- function(x, n) binom.test(x, n, chance, "greater")$p.value
correctIn <- function(condition) sum(inCondition(condition, "Q1_correct"))
trialsIn <- function(condition) length(inCondition(condition, "Q1_correct"))

choiceResult <- function(condition) {
  x <- correctIn(condition); n <- trialsIn(condition)
  list(trials = number(n), correct = number(x), matches_per_rendering = number(length(participants) * x / n),
       proportion = number(x / n), ci95 = wilson(x, n), p_chance = number(exactP(x, n)),
       p_chance_participants = number(t.test(meansOf("Q1_correct")[, condition], mu = chance)$p.value))
}
ratingResult <- function(question) function(condition) {
  ratings <- inCondition(condition, question)
  means <- meansOf(question)[, condition]
  list(n = number(length(ratings)), mean = number(mean(ratings)), sd = number(sd(ratings)),
       participants = number(length(means)), ci95 = t.test(means)$conf.int[1:2], mean_of_participants = number(mean(means)))
}

# ---- pairs of conditions --------------------------------------------------------------------------------------------
# Means over the fabrics that a participant answered under each of these conditions.
commonMeansOf <- function(question, some) {
  cells <- tapply(answers[[question]], list(answers$participant, answers$fabric, answers$condition), mean)[participants, , some]
  isMissing <- apply(is.na(cells), 1:2, any)
  for (condition in some) cells[, , condition][isMissing] <- NA
  apply(cells, c(1, 3), mean, na.rm = TRUE)
}
differences <- function(question, pair) {
  means <- commonMeansOf(question, pair)
  means[, pair[1]] - means[, pair[2]]
}
# The reference numbers behind statistics.json take all fabrics that are answered under a condition.
answeredDifferences <- function(question, pair) meansOf(question)[, pair[1]] - meansOf(question)[, pair[2]]
pairedT <- function(question, differencesOf = differences) lapply(pairs, function(pair) t.test(differencesOf(question, pair)))
holm <- function(question, differencesOf = differences)
  p.adjust(sapply(pairedT(question, differencesOf), function(test) test$p.value), "holm")
# Two one-sided tests (Schuirmann 1987).
tost <- function(question, pair, differencesOf = differences) {
  d <- differencesOf(question, pair)
  list(lower = t.test(d, mu = bounds[1], alternative = "greater"), upper = t.test(d, mu = bounds[2], alternative = "less"),
       ci90 = t.test(d, conf.level = 0.9)$conf.int[1:2], estimate = mean(d), n = length(d), dz = mean(d) / sd(d),
       p = t.test(d)$p.value)
}
comparisons <- function(question, name) Map(function(pair, test, p_holm) {
  d <- differences(question, pair)
  list(question = unbox(name), a = unbox(pair[1]), b = unbox(pair[2]), test = unbox("paired-t"), n = number(length(d)),
       statistic = number(test$statistic), df = number(test$parameter), p = number(test$p.value), p_holm = number(p_holm),
       mean_difference = number(mean(d)), ci95 = test$conf.int[1:2], d_z = number(mean(d) / sd(d)))
}, pairs, pairedT(question), holm(question))
equivalences <- function(question) Map(function(pair, p_holm) {
  test <- tost(question, pair)
  p <- max(test$lower$p.value, test$upper$p.value)
  verdict <- paste(if (p_holm < 0.05) "different" else "not different", if (p < 0.05) "equivalent" else "not shown equivalent",
                   sep = " / ")
  list(question = unbox(question), a = unbox(pair[1]), b = unbox(pair[2]), bounds = bounds,
       p_lower = number(test$lower$p.value), p_upper = number(test$upper$p.value), p = number(p), equivalent = unbox(p < 0.05),
       n = number(test$n), mean_difference = number(test$estimate), ci90 = test$ci90, verdict = unbox(verdict))
}, pairs, holm(question))

# ---- speed and accuracy of Q1 -----------------------------------------------------------------------------------------
# Balanced integration score (Liesefeld and Janczyk 2019): z(share correct) - z(mean time), SD of the population.
z <- function(x) (x - mean(x)) / sqrt(mean((x - mean(x))^2))
bis <- z(as.vector(meansOf("Q1_correct"))) - z(as.vector(meansOf("Q1_seconds")))
bisOf <- colMeans(matrix(bis, length(participants), dimnames = list(participants, conditions)))
# Wolpaw et al. 1998.
bits <- function(p, m) if (p <= 1 / m) 0 else log2(m) + p * log2(p) + ifelse(p < 1, (1 - p) * log2((1 - p) / (m - 1)), 0)
bisCells <- matrix(bis, length(participants), dimnames = list(participants, conditions))
# Limits of a ratio from those of its parts, Student's t over participants (MOVER: Donner and Zou 2012).
rateInterval <- function(condition) {
  ps <- t.test(meansOf("Q1_correct")[, condition])$conf.int; b <- t.test(meansOf("Q1_seconds")[, condition])$conf.int
  p <- bits(correctIn(condition) / trialsIn(condition), 3); t <- mean(inCondition(condition, "Q1_seconds"))
  l <- bits(max(0, ps[1]), 3); u <- bits(min(1, ps[2]), 3)
  c((p * t - sqrt((p * t)^2 - l * b[2] * (2 * p - l) * (2 * t - b[2]))) / (b[2] * (2 * t - b[2])),
    (p * t + sqrt((p * t)^2 - u * b[1] * (2 * p - u) * (2 * t - b[1]))) / (b[1] * (2 * t - b[1])))
}
# Student's t of the participants' log medians, around the log median of all times.
medianInterval <- function(condition) {
  here <- answers[answers$condition == condition & !is.na(answers$Q1_seconds), ]
  own <- log(tapply(here$Q1_seconds, here$participant, median))
  exp(log(median(here$Q1_seconds)) + c(-1, 1) * qt(0.975, length(own) - 1) * sd(own) / sqrt(length(own)))
}
speed <- function(condition) {
  seconds <- inCondition(condition, "Q1_seconds")
  list(median_seconds = number(median(seconds)),
       bits_per_second = number(bits(correctIn(condition) / trialsIn(condition), 3) / mean(seconds)),
       bis = number(bisOf[condition]), bits_per_second_ci95 = rateInterval(condition),
       bis_ci95 = t.test(bisCells[, condition])$conf.int[1:2], median_seconds_ci95 = medianInterval(condition))
}
choices <- answers[!is.na(answers$Q1_correct), ]
# Two conditions are compared on the fabrics that a participant has a choice and a time for under both.
timedUnder <- function(pair) {
  d <- choices[choices$condition %in% pair & !is.na(choices$Q1_seconds), ]
  d[ave(seq_along(d$fabric), d$participant, d$fabric, FUN = length) == 2, ]
}
byCell <- function(d, value) tapply(value, list(d$participant, factor(d$condition, conditions)), mean)[participants, ]
# Jackknife pseudo-values of bits per second (Tukey 1958).
pseudoOf <- function(pair) sapply(pair, function(condition) {
  rate <- function(d) bits(mean(d$Q1_correct), 3) / mean(d$Q1_seconds)
  d <- timedUnder(pair); d <- d[d$condition == condition, ]; n <- length(participants)
  sapply(participants, function(p) n * rate(d) - (n - 1) * rate(d[d$participant != p, ])) })
# Standardised over the cells of all conditions; those of the pair are the cells that are compared.
bisOfPair <- function(pair) {
  d <- timedUnder(pair); shares <- meansOf("Q1_correct"); times <- meansOf("Q1_seconds")
  shares[, pair] <- byCell(d, d$Q1_correct)[, pair]; times[, pair] <- byCell(d, d$Q1_seconds)[, pair]
  matrix(z(as.vector(shares)) - z(as.vector(times)), length(participants), dimnames = list(participants, conditions))
}
logTimesOf <- function(pair) { d <- timedUnder(pair); byCell(d, log(d$Q1_seconds)) }
meanTest <- function(x) {
  test <- t.test(x)
  list(n = number(length(x)), estimate = number(test$estimate), ci95 = test$conf.int[1:2], statistic = number(test$statistic),
       df = number(test$parameter), p = number(test$p.value))
}
measures <- list(bits_per_second = pseudoOf, bis = bisOfPair, log_seconds = logTimesOf)
speedTests <- lapply(measures, function(of) lapply(pairs, function(pair) meanTest(of(pair)[, pair[1]] - of(pair)[, pair[2]])))
speedHolm <- lapply(speedTests, function(tests) p.adjust(sapply(tests, function(test) test$p), "holm"))
speedContrasts <- do.call(c, lapply(seq_along(pairs), function(i) lapply(names(measures), function(measure) {
  c(list(a = unbox(pairs[[i]][1]), b = unbox(pairs[[i]][2]), measure = unbox(measure), primary = unbox(FALSE),
         planned = unbox(FALSE), generalises_to = unbox("these_fabrics")), speedTests[[measure]][[i]],
    list(p_holm = number(speedHolm[[measure]][i]))) })))
# Conditional accuracy: parts of each participant's own times, with at least two choices in a part.
binned <- function(d, count) {
  ends <- quantile(d$Q1_seconds, seq_len(count - 1) / count)
  bin <- factor(1 + rowSums(outer(d$Q1_seconds, ends, ">")), levels = seq_len(count))
  data.frame(bin = seq_len(count), n = as.vector(table(bin)), seconds = as.vector(tapply(d$Q1_seconds, bin, mean)),
             share = as.vector(tapply(d$Q1_correct, bin, mean)))
}
bins <- function(d, count) {
  parts <- Filter(function(one) nrow(one) >= 2 * count, split(d, d$participant))
  rows <- do.call(rbind, lapply(parts, binned, count))
  lapply(seq_len(count), function(k) {
    x <- rows[rows$bin == k, ]; interval <- t.test(x$share)$conf.int
    list(bin = number(k), choices = number(sum(x$n)), participants = number(nrow(x)), mean_seconds = number(mean(x$seconds)),
         proportion = number(mean(x$share)), ci95 = c(max(0, interval[1]), min(1, interval[2]))) })
}
accuracySlopes <- sapply(split(choices, choices$participant), function(d)
  coef(lm(Q1_correct ~ log2(Q1_seconds) + condition + fabric, d))[2])
conditionalAccuracy <- list(
  bins = bins(choices, 4), conditions = named(conditions, function(c) bins(choices[choices$condition == c, ], 2)),
  trend = c(list(generalises_to = unbox("these_fabrics"), per = unbox("doubling of the response time")), meanTest(accuracySlopes)))
times <- function(column) function(condition) {
  seconds <- if (is.null(column)) numeric() else inCondition(condition, column)
  if (length(seconds) == 0) return(list(n = number(0)))
  list(n = number(length(seconds)), median_seconds = number(median(seconds)), mean_seconds = number(mean(seconds)),
       log_mean = number(mean(log(seconds))), geometric_mean_seconds = number(exp(mean(log(seconds)))))
}

# ---- choices: all conditions --------------------------------------------------------------------------------------------
perCondition <- Map(function(condition, p_holm) {
  x <- correctIn(condition); n <- trialsIn(condition)
  list(condition = unbox(condition), correct = number(x), trials = number(n),
       mean_matches_per_rendering_of_6 = number(6 * x / n), p_exact_greater_one_third = number(exactP(x, n)),
       p_holm = number(p_holm), cp95 = clopperPearson(x, n), wilson95 = wilson(x, n))
}, conditions, p.adjust(mapply(exactP, sapply(conditions, correctIn), sapply(conditions, trialsIn)), "holm"))

# Cochran's Q on the blocks of participant x fabric that are answered in every condition.
cochran <- local({
  blocks <- reshape(answers[c("participant", "fabric", "condition", "Q1_correct")], idvar = c("participant", "fabric"),
                    timevar = "condition", direction = "wide")
  x <- as.matrix(blocks[complete.cases(blocks), -(1:2)])
  k <- ncol(x)
  q <- k * (k - 1) * sum((colSums(x) - mean(colSums(x)))^2) / sum(rowSums(x) * (k - rowSums(x)))
  list(Q = number(q), df = number(k - 1), p = number(pchisq(q, k - 1, lower.tail = FALSE)), blocks = number(nrow(x)),
       note = unbox("blocks = participant x fabric; ignores clustering, descriptive only"))
})
participantLevel <- local({
  shares <- tapply(answers$Q1_correct, answers$participant, mean, na.rm = TRUE)[participants]
  test <- t.test(shares, mu = chance)
  list(prop = lapply(as.list(shares), number), t_vs_third = number(test$statistic), df = number(test$parameter),
       p = number(test$p.value))
})
glmm <- local({
  ordered <- within(answers, condition <- factor(condition, levels = conditions))
  model <- glmer(Q1_correct ~ condition + (1 | participant) + (1 | fabric), ordered, family = binomial,
                 control = glmerControl(optimizer = "bobyqa", tolPwrss = 1e-12, optCtrl = list(rhoend = 1e-10, maxfun = 1e6)))
  null <- update(model, . ~ . - condition)
  effects <- summary(model)$coefficients
  standardErrors <- sqrt(diag(as.matrix(vcov(model, use.hessian = TRUE))))
  sds <- sqrt(unlist(VarCorr(model)))
  chi2 <- as.numeric(2 * (logLik(model) - logLik(null)))
  list(method = unbox("Laplace"), formula = unbox("correct~condition+(1|participant)+(1|fabric)"),
       fixef = lapply(as.list(effects[, 1]), number), se = lapply(as.list(standardErrors), number),
       sd_participant = number(sds["participant"]), sd_fabric = number(sds["fabric"]), logLik = number(as.numeric(logLik(model))),
       lrt_chi2 = number(chi2), lrt_df = number(2), lrt_p = number(pchisq(chi2, 2, lower.tail = FALSE)), warn = unbox(FALSE),
       singular = unbox(FALSE), rows = number(sum(!is.na(answers$Q1_correct))))
})
# d' of the observer who picks the largest of three impressions (Green and Swets 1966); standard error by the delta method.
sensitivity <- function(condition) {
  n <- trialsIn(condition); p <- correctIn(condition) / n
  shareAt <- function(d) integrate(function(x) dnorm(x - d) * pnorm(x)^2, -12, 20, rel.tol = 1e-12)$value
  slopeAt <- function(d) integrate(function(x) (x - d) * dnorm(x - d) * pnorm(x)^2, -12, 20, rel.tol = 1e-12)$value
  d <- uniroot(function(d) shareAt(d) - p, c(0, 8), tol = 1e-13)$root
  # The same d' of the mean share, with intervals over participants, and over participants and fabrics.
  dPrimeOf <- function(share) if (share <= chance) 0 else if (share >= 1) NA else
    uniroot(function(d) shareAt(d) - share, c(0, 8), tol = 1e-13)$root
  clustered <- function(to, share, ci) {
    ci <- pmin(1, pmax(0, ci))
    row <- list(generalises_to = unbox(to), share = number(share), share_ci95 = ci, d_prime = number(dPrimeOf(share)),
                d_prime_low = number(dPrimeOf(ci[1])), d_prime_high = number(dPrimeOf(ci[2])))
    if (ci[1] <= chance) row$note <- unbox("at or below chance d' is set to 0")
    if (ci[2] >= 1) row$why <- list(d_prime_high = unbox("at a share of 1 d' has no upper bound"))
    row
  }
  list(d_prime = number(d), se = number(sqrt(p * (1 - p) / n) / slopeAt(d)), generalises_to = unbox("these_trials"),
       clustered = list(
         with(t.test(meansOf("Q1_correct")[, condition]), clustered("these_fabrics", unname(estimate), conf.int[1:2])),
         with(crossedMean(condition), clustered("fabrics_like_these", estimate, estimate + c(-1, 1) * qt(0.975, df) * se))))
}
# Mean of the choices with crossed random intercepts; a variance at zero is left out. No condition has both at zero.
crossedMean <- function(condition) {
  cells <- answers[answers$condition == condition & !is.na(answers$Q1_correct), ]
  model <- lmer(Q1_correct ~ 1 + (1 | participant) + (1 | fabric), cells, control = tight)
  for (group in c("participant", "fabric"))
    if (VarCorr(model)[[group]][1] < 1e-8)
      model <- lmer(formula(paste("Q1_correct ~ 1 + (1 |", setdiff(c("participant", "fabric"), group), ")")), cells, control = tight)
  row <- summary(model)$coefficients[1, ]
  list(estimate = unname(row["Estimate"]), se = unname(row["Std. Error"]), df = unname(row["df"]))
}
tight <- lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-12, maxfun = 1e6))
confusion <- list(answered = named(fabrics, function(truth) named(fabrics, function(chosen) {
  number(sum(answers$fabric == truth & answers$Q1_answer == chosen, na.rm = TRUE)) })), slots = setNames(list(), character()))
byRendering <- named(conditions, function(c) named(fabrics, function(f) {
  values <- answers$Q1_correct[answers$condition == c & answers$fabric == f]
  list(correct = number(sum(values, na.rm = TRUE)), trials = number(sum(!is.na(values))))
}))

# ---- ratings: all conditions ------------------------------------------------------------------------------------------
ratingStatistics <- function(question) {
  x <- meansOf(question)
  n <- nrow(x); k <- ncol(x)
  grand <- mean(x)
  ssCondition <- n * sum((colMeans(x) - grand)^2)
  ssSubject <- k * sum((rowMeans(x) - grand)^2)
  ssError <- sum((x - grand)^2) - ssCondition - ssSubject
  f <- (ssCondition / (k - 1)) / (ssError / ((k - 1) * (n - 1)))
  # Greenhouse and Geisser 1959 from the double-centred covariance; Huynh and Feldt 1976.
  s <- cov(x); centred <- s - outer(rowMeans(s), colMeans(s), "+") + mean(s)
  gg <- sum(diag(centred))^2 / ((k - 1) * sum(centred^2))
  hf <- (n * (k - 1) * gg - 2) / ((k - 1) * (n - 1 - (k - 1) * gg))
  pOf <- function(epsilon) pf(f, epsilon * (k - 1), epsilon * (k - 1) * (n - 1), lower.tail = FALSE)
  friedman <- friedman.test(x)
  iman <- unname((n - 1) * friedman$statistic / (n * (k - 1) - friedman$statistic))
  # Morey 2008: within-subject intervals.
  normalised <- x - rowMeans(x) + grand
  morey <- qt(0.975, n - 1) * apply(normalised, 2, sd) / sqrt(n) * sqrt(k / (k - 1))
  # Shrout and Fleiss 1979: conditions are the targets, participants the raters.
  msTarget <- ssCondition / (k - 1); msRater <- ssSubject / (n - 1); msError <- ssError / ((k - 1) * (n - 1))
  icc <- list(ICC2 = (msTarget - msError) / (msTarget + (n - 1) * msError + n * (msRater - msError) / k),
              ICC2k = (msTarget - msError) / (msTarget + (msRater - msError) / k),
              ICC3 = (msTarget - msError) / (msTarget + (n - 1) * msError), ICC3k = (msTarget - msError) / msTarget)
  data <- within(answers, condition <- factor(condition, levels = conditions))
  data$rating <- data[[question]]
  model <- lmer(rating ~ condition + (1 | participant) + (1 | fabric) + (1 | participant:condition) + (1 | fabric:condition),
                data, control = lmerControl(optimizer = "bobyqa", optCtrl = list(rhoend = 1e-12, maxfun = 1e6)))
  test <- anova(model)
  effects <- summary(model)$coefficients
  variances <- as.data.frame(VarCorr(model))
  result <- list(
    cell_mean = named(conditions, function(c) number(mean(inCondition(c, question)))),
    n_ratings = named(conditions, function(c) number(length(inCondition(c, question)))),
    participants_complete = participants,
    participant_mean_table = lapply(participants, function(p) list(participant = unbox(p), means = unname(x[p, ]))),
    morey95_halfwidth = lapply(as.list(morey), number),
    rm_anova = list(F = number(f), df1 = number(k - 1), df2 = number((k - 1) * (n - 1)), p = number(pOf(1)),
                    eps_gg = number(gg), p_gg = number(pOf(gg)), eps_hf = number(hf), p_hf = number(pOf(min(1, hf))),
                    pes = number(ssCondition / (ssCondition + ssError)), n = number(n)),
    friedman = list(Q = number(friedman$statistic), df = number(k - 1), p = number(friedman$p.value),
                    kendall_w = number(friedman$statistic / (n * (k - 1))), iman_davenport_F = number(iman),
                    iman_davenport_p = number(pf(iman, k - 1, (k - 1) * (n - 1), lower.tail = FALSE)), n = number(n)),
    lmm = list(formula = unbox("y~condition+(1|participant)+(1|fabric)+(1|participant:condition)+(1|fabric:condition)"),
               fixef = lapply(as.list(effects[, 1]), number), se = lapply(as.list(effects[, 2]), number),
               var = lapply(as.list(setNames(variances$vcov, variances$grp)), number),
               REML_criterion = number(REMLcrit(model)), F = number(test[["F value"]]), num_df = number(test$NumDF),
               den_df = number(test$DenDF), p = number(test[["Pr(>F)"]]), singular = unbox(FALSE),
               rows = number(sum(!is.na(data$rating)))),
    pairwise_t_participant_means = Map(function(pair, t, p_holm) {
      list(a = unbox(pair[1]), b = unbox(pair[2]), diff = number(t$estimate), t = number(t$statistic),
           df = number(t$parameter), p = number(t$p.value), p_holm = number(p_holm), n = number(n))
    }, pairs, pairedT(question, answeredDifferences), holm(question, answeredDifferences)))
  for (pair in pairs) {
    name <- paste0("tost_", gsub("[^A-Za-z0-9]", "", pair[1]), "_vs_", gsub("[^A-Za-z0-9]", "", pair[2]), "_participant")
    test <- tost(question, pair, answeredDifferences)
    result[[name]] <- list(
      bounds = bounds, estimate = number(test$estimate), t_lower = number(test$lower$statistic),
      p_lower = number(test$lower$p.value), t_upper = number(test$upper$statistic), p_upper = number(test$upper$p.value),
      p_tost = number(max(test$lower$p.value, test$upper$p.value)), ci90 = test$ci90, nhst_p = number(test$p),
      dz = number(test$dz), n = number(test$n))
  }
  result$icc_conditions_by_participants <- lapply(icc, number)
  result
}

# ---- effect sizes, evidence, agreement, variances ---------------------------------------------------------------------
inOrder <- within(answers, condition <- factor(condition, levels = conditions))
effectSizes <- function(question) {
  means <- data.frame(y = c(commonMeansOf(question, conditions)), participant = participants, condition = rep(conditions, each = length(participants)))
  sizes <- suppressMessages(anova(afex::aov_ez("participant", "y", means, within = "condition"), es = c("ges", "pes")))
  list(n = number(length(participants)), generalises_to = unbox("these_fabrics"), partial_eta_squared = number(sizes$pes),
       generalised_eta_squared = number(sizes$ges))
}
# On the fabrics that a participant answered under both conditions.
bayesFactors <- function(question) list(
  prior_scale = number(sqrt(2) / 2), generalises_to = unbox("these_fabrics"),
  contrasts = lapply(pairs, function(pair) {
    cells <- tapply(answers[[question]], list(answers$participant, answers$fabric, answers$condition), mean)
    d <- rowMeans(cells[participants, , pair[1]] - cells[participants, , pair[2]], na.rm = TRUE)
    bf <- BayesFactor::extractBF(BayesFactor::ttestBF(d, rscale = sqrt(2) / 2), logbf = TRUE)$bf
    list(a = unbox(pair[1]), b = unbox(pair[2]), planned = unbox(FALSE), n = number(length(d)),
         t = number(t.test(d)$statistic), bf10 = number(exp(bf)), log10_bf10 = number(bf / log(10)))
  }))
agreement <- function(question) {
  stimuli <- tapply(answers[[question]], list(paste(answers$condition, answers$fabric), answers$participant), mean)
  stimuli <- stimuli[complete.cases(stimuli), ]
  icc <- psych::ICC(stimuli, lmer = FALSE)$results
  of <- function(type) which(icc$type == type)
  part <- list(stimuli = number(nrow(stimuli)), raters = number(ncol(stimuli)), left_out = list())
  for (type in c("ICC2", "ICC2k", "ICC3", "ICC3k")) {
    part[[type]] <- number(icc$ICC[of(type)])
    part[[paste0(type, "_ci95")]] <- c(icc[of(type), "lower bound"], icc[of(type), "upper bound"])
  }
  part
}
components <- function(variances, unit) {
  sd <- sqrt(variances["fabric:condition"])
  meaning <- if (sd < 1e-4)
    "No variance of fabric \u00d7 condition was found. With few fabrics this does not show that there is none."
  else sprintf(paste("Fabric \u00d7 condition has %.0f %% of the variance. A difference of two conditions varies from fabric to",
                     "fabric with an SD of %.2f %s."), 100 * variances["fabric:condition"] / sum(variances), sqrt(2) * sd, unit)
  order <- c("participant", "fabric", "participant:condition", "fabric:condition", "Residual")
  list(unit = unbox(unit), components = lapply(order, function(name) list(
         name = unbox(name), sd = number(sqrt(variances[name])), variance = number(variances[name]),
         share = number(variances[name] / sum(variances)), estimated_as_zero = unbox(unname(variances[name] < 1e-8)))),
       left_out = setNames(list(), character()), meaning = unbox(meaning))
}
ratingModel <- function(question) {
  inOrder$rating <- inOrder[[question]]
  lmer(rating ~ condition + (1 | participant) + (1 | fabric) + (1 | participant:condition) + (1 | fabric:condition), inOrder,
       control = tight)
}
crossedChoices <- glmer(
  Q1_correct ~ condition + (1 | participant) + (1 | fabric) + (1 | participant:condition) + (1 | fabric:condition), inOrder,
  family = binomial, control = glmerControl(optimizer = "bobyqa", tolPwrss = 1e-12, optCtrl = list(rhoend = 1e-10, maxfun = 1e6)))
variancesOf <- function(model, residual) {
  table <- as.data.frame(VarCorr(model))
  variances <- setNames(table$vcov, table$grp)
  if (!is.null(residual)) variances["Residual"] <- residual
  ifelse(variances < 1e-8, 0, variances)
}
rSquared <- function(model, unit, residual) {
  fixed <- var(as.vector(model.matrix(model) %*% fixef(model)))
  variances <- variancesOf(model, residual)
  all <- fixed + sum(variances)
  r2 <- list(marginal = fixed / all, conditional = 1 - unname(variances["Residual"]) / all)
  # performance leaves the random effects out of the R squared of a singular model.
  invisible(capture.output(peer <- suppressWarnings(performance::r2_nakagawa(model, tolerance = 1e-9))))
  if (!is.na(peer$R2_conditional)) stopifnot(abs(peer$R2_marginal - r2$marginal) < 1e-6, abs(peer$R2_conditional - r2$conditional) < 1e-6)
  list(scale = unbox(unit), condition_variance = number(fixed), marginal = number(r2$marginal), conditional = number(r2$conditional))
}

# ---- the data themselves ----------------------------------------------------------------------------------------------
columns <- c(Q1 = "Q1_correct", Q2 = "Q2", Q3 = "Q3")
missingIn <- named(names(columns), function(q) named(conditions, function(c) {
  number(length(participants) * length(fabrics) - length(inCondition(c, columns[q]))) }))
expected <- length(participants) * length(fabrics) * length(conditions) * length(columns)
present <- sum(!is.na(answers[columns]))
# P2 answered once within 0.5 s, P6 gave one number to Q3 in more than half of the presentations.
kept <- setdiff(participants, c("P2", "P6"))
screening <- list(
  excluded = list(list(participant = unbox("P2"), flags = "too_fast"), list(participant = unbox("P6"), flags = "straight_lining")),
  participants = list(before = number(6), after = number(4)),
  questions = named(names(columns), function(q) named(conditions, function(c) {
    means <- meansOf(columns[q])[, c]
    list(before = number(mean(means)), after = number(mean(means[kept]))) })))

results <- list(
  questions = list(Q1 = named(conditions, choiceResult), Q2 = named(conditions, ratingResult("Q2")),
                   Q3 = named(conditions, ratingResult("Q3"))),
  comparisons = c(comparisons("Q1_correct", "Q1"), comparisons("Q2", "Q2"), comparisons("Q3", "Q3")),
  equivalence = c(equivalences("Q2"), equivalences("Q3")), speed_accuracy = named(conditions, speed))
statistics <- list(
  data = list(responses = number(present), expected_responses = number(expected), missing_responses = number(expected - present),
              missing_by_condition = missingIn),
  q1_per_condition = unname(perCondition), q1_cochran = cochran, q1_participant_level = participantLevel, q1_glmm = glmm,
  q1_sensitivity = named(conditions, sensitivity), q1_confusion = confusion, q1_matches_by_rendering = byRendering,
  q1_speed_accuracy_contrasts = list(contrasts = speedContrasts), q1_conditional_accuracy = conditionalAccuracy,
  Q2 = ratingStatistics("Q2"), Q3 = ratingStatistics("Q3"),
  reliability = list(Q2 = agreement("Q2"), Q3 = agreement("Q3")),
  bayes_factors = list(Q1 = bayesFactors("Q1_correct"), Q2 = bayesFactors("Q2"), Q3 = bayesFactors("Q3")),
  effect_sizes = list(Q1 = effectSizes("Q1_correct"), Q2 = effectSizes("Q2"), Q3 = effectSizes("Q3")),
  r_squared = list(Q1 = rSquared(crossedChoices, "log odds", pi^2 / 3), Q2 = rSquared(ratingModel("Q2"), "scale points", NULL),
                   Q3 = rSquared(ratingModel("Q3"), "scale points", NULL)),
  variance_components = list(Q1 = components(variancesOf(crossedChoices, pi^2 / 3), "log odds"),
                             Q2 = components(variancesOf(ratingModel("Q2"), NULL), "scale points"),
                             Q3 = components(variancesOf(ratingModel("Q3"), NULL), "scale points")),
  screening = screening,
  response_times = list(Q1 = named(conditions, times("Q1_seconds")), Q2 = named(conditions, times(NULL)),
                        Q3 = named(conditions, times(NULL))))
cat(toJSON(list(results = results, statistics = statistics), digits = NA, pretty = 1), "\n")

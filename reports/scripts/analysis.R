# Computes the main tables of the report again, and compares them with expected.csv.
#   Rscript analysis.R          in this folder
#   Rscript analysis.R all      also fits models that take longer than minutes
# Reads answers.csv (one row an answer), anchors.csv where there are any, and expected.csv (one row a number of the report);
# codebook.csv explains them.
# Base R computes means, t tests and two one-sided t tests. Linear mixed models need the packages lme4 and lmerTest, logistic ones
# lme4, ordinal ones ordinal. Without a package the script leaves its numbers out and says so.
#
# Tolerances. A number with a formula agrees to 1e-7 of itself. A fitted number also depends on where the optimiser stops:
#   - linear models 1e-5: lme4 finds variances to about 1e-8 of the residual variance;
#   - logistic and ordinal models 1e-3: clmm stops up to 2e-4 standard errors beside the maximum. Second differences give lme4's
#     standard errors to about 1e-4. Log likelihoods agree to 1e-6.
# These tolerances are relative to the number, or to a least size where that is larger:
#   - estimates and ends of intervals: their standard error;
#   - t, F, chi squared: 1;
#   - standard deviations, which are compared as variances: 1 % of the residual variance (of 1 for log odds);
#   - p values and odds ratios, which are compared as logarithms: 1.
options(contrasts = c("contr.treatment", "contr.poly"), scipen = 0, OutDec = ".")  # a .Rprofile may have set others
tolerances <- c(linear = 1e-5, logistic = 1e-3, ordinal = 1e-3)
many <- if ("all" %in% commandArgs(trailingOnly = TRUE)) Inf else 1
mostAnswers <- many * c(linear = 10000, logistic = 5000, ordinal = 2000)
mostContrasts <- many * 100

answers <- read.csv("answers.csv", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = "")
expected <- read.csv("expected.csv", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = "")
if (nrow(expected) == 0) {
  cat("the report has no numbers of choices or ratings: there is nothing to compute\nreproduced: 0 of 0\n")
  quit(status = 0)
}
for (name in c("low", "high", "value")) expected[[name]] <- as.numeric(expected[[name]])
for (name in c("a", "b")) expected[[name]][is.na(expected[[name]])] <- ""
answers$value <- as.numeric(ifelse(is.na(answers$correct), answers$rating, answers$correct))
answers <- answers[!is.na(answers$value), ]
for (name in c("repetition", "instruction")) answers[[name]][is.na(answers[[name]])] <- ""
conditions <- unique(expected$a[expected$section %in% c("matches", "ratings")])
choices <- unique(expected$question[expected$section == "matches"])

# ---- means of the participants ----------------------------------------------------------------------------------------------

kept <- new.env()
once <- function(name, value) {
  if (!exists(name, kept, inherits = FALSE)) assign(name, orNothing(value), kept)
  kept[[name]]
}
valuesOf <- function(question, condition) answers$value[answers$question == question & answers$condition == condition]
# Means over repetitions, [participant, fabric, condition].
cellsOf <- function(question) once(paste("cells", question), {
  own <- answers[answers$question == question, ]
  tapply(own$value, list(own$participant, own$fabric, factor(own$condition, conditions)), mean)
})
# Answers in a full cell.
mostOf <- function(question) once(paste("most", question), {
  own <- answers[answers$question == question, ]
  max(table(paste(own$participant, own$fabric, own$condition, sep = "\r")))
})
# What matches the answers of cells with several: the name of the repetition, else the instruction, else nothing.
marks <- list(function(x) paste(x$repetition, x$instruction, sep = "\r"), function(x) x$instruction, function(x) rep("", nrow(x)))
# The answers that each participant gave, about each fabric, under all of these conditions, or under all that have answers there.
# Names of repetitions may be mere row numbers, or those of sessions that belong to one condition. They count where the conditions
# share them: they meet, and full cells of one participant and fabric have the same. Instructions only have to be the same.
commonAnswers <- function(question, conditions, needsAll)
  once(paste(c("common", needsAll, question, conditions), collapse = "\r"), {
    own <- answers[answers$question == question & answers$condition %in% conditions, ]
    own$place <- paste(own$participant, own$fabric, sep = "\r")
    own$cell <- paste(own$place, own$condition, sep = "\r")
    met <- function(by) ave(match(own$condition, conditions), by, FUN = function(x) length(unique(x)))
    needed <- if (needsAll) length(conditions) else met(own$place)
    isFull <- ave(own$value, own$cell, FUN = length) == mostOf(question)
    for (k in if (mostOf(question) < 2) 3 else 1:3) {
      own$label <- marks[[k]](own)
      isCommon <- met(paste(own$place, own$label, sep = "\r")) == needed
      labels <- tapply(own$label[isFull], own$cell[isFull], function(x) paste(sort(x), collapse = "\n"))
      isSame <- tapply(labels, own$place[match(names(labels), own$cell)], function(x) length(unique(x)) == 1)
      if (k == 3 || (all(isSame) && (k == 2 || any(isCommon & met(own$place) > 1)))) break
    }
    own[isCommon, ]
  })
# Their means, [participant, fabric, condition]. Labels with unequally many answers under the conditions count equally.
commonCells <- function(question, conditions, needsAll = TRUE) {
  whole <- cellsOf(question)
  if (mostOf(question) < 2) return(whole[, , conditions, drop = FALSE])
  own <- commonAnswers(question, conditions, needsAll)
  labels <- c(tapply(own$label, own$cell, function(x) paste(sort(x), collapse = "\n")))[own$cell]
  isEven <- ave(match(labels, labels), own$place, FUN = function(x) length(unique(x))) == 1
  weight <- ifelse(isEven, 1, 1 / ave(own$value, own$cell, own$label, FUN = length))
  place <- list(factor(own$participant, dimnames(whole)[[1]]), factor(own$fabric, dimnames(whole)[[2]]),
                factor(own$condition, conditions))
  tapply(weight * own$value, place, sum) / tapply(weight, place, sum)
}
# Whether two conditions are compared on other means than those of their cells.
isOther <- function(question, a, b) {
  both <- commonCells(question, c(a, b))
  whole <- cellsOf(question)[, , c(a, b), drop = FALSE]
  isThere <- !is.na(under(whole, a) - under(whole, b))
  own <- rep(isThere, 2)
  anyNA(both[own]) || any(abs(both[own] - whole[own]) > 1e-12 * abs(whole[own]))
}
under <- function(cells, condition) cells[, , condition, drop = FALSE]
participantMeans <- function(x) if (length(x) > 0) apply(x, 1, mean, na.rm = TRUE) else numeric()
meansOf <- function(question, condition) participantMeans(under(cellsOf(question), condition))
without <- function(x) x[!is.na(x)]

# A test that cannot be done gives no number.
orNothing <- function(test) tryCatch(test, error = function(e) NULL)
quietly <- function(fit) suppressMessages(suppressWarnings(fit))
# Means of equal numbers may differ in the last digit.
areEqual <- function(x) length(x) < 2 || diff(range(x)) <= 1e-14 * max(abs(x))
testOf <- function(x, ...) if (areEqual(x)) NULL else orNothing(t.test(x, ...))

matches <- function(question, condition, chance) {
  value <- valuesOf(question, condition)
  test <- orNothing(binom.test(sum(value), length(value), chance, alternative = "greater"))
  shares <- testOf(without(meansOf(question, condition)), mu = chance)
  list(correct = sum(value), trials = length(value), proportion = mean(value), p_chance = test$p.value,
       p_chance_participants = shares$p.value)
}
ratings <- function(question, condition) {
  value <- valuesOf(question, condition)
  means <- without(meansOf(question, condition))
  interval <- testOf(means)$conf.int
  list(n = length(value), mean = mean(value), sd = sd(value), ci95_low = interval[1], ci95_high = interval[2])
}
# Each participant's means over the fabrics, and repetitions, that have an answer under both conditions.
differences <- function(question, a, b) {
  both <- commonCells(question, c(a, b))
  first <- under(both, a)
  second <- under(both, b)
  first[is.na(second)] <- NA
  second[is.na(first)] <- NA
  without(participantMeans(first) - participantMeans(second))
}
comparison <- function(question, a, b) {
  d <- differences(question, a, b)
  test <- testOf(d)
  list(n = length(d), mean_difference = mean(d), statistic = test$statistic[[1]], df = test$parameter[[1]], p = test$p.value,
       ci95_low = test$conf.int[1], ci95_high = test$conf.int[2], d_z = if (!is.null(test)) mean(d) / sd(d))
}

# Two one-sided t tests; the interval of 90 % holds what they do not reject.
equivalence <- function(question, a, b, low, high) {
  d <- differences(question, a, b)
  below <- testOf(d, mu = low, alternative = "greater")
  above <- testOf(d, mu = high, alternative = "less")
  interval <- testOf(d, conf.level = 0.9)$conf.int
  list(n = length(d), mean_difference = mean(d), p_lower = below$p.value, p_upper = above$p.value,
       ci90_low = interval[1], ci90_high = interval[2])
}

# ---- anchors ----------------------------------------------------------------------------------------------------------------

anchors <- if (file.exists("anchors.csv")) read.csv("anchors.csv", colClasses = "character", check.names = FALSE,
                                                    encoding = "UTF-8", na.strings = "")
anchorsOf <- function(question, kind) anchors[anchors$question == question & anchors$kind == kind, ]
anchorFloor <- function(question) {
  own <- anchorsOf(question, "mismatched")
  value <- as.numeric(own$first)
  means <- c(tapply(value, own$participant, mean))
  interval <- testOf(means)$conf.int
  list(n = length(value), mean = mean(value), sd = sd(value), ci95_low = interval[1], ci95_high = interval[2])
}
# ICC(2,1) of two answers each, from the table of the analysis of variance; none of a single pair, or of pairs that do
# not differ.
intraclass <- function(x, y) {
  n <- length(x)
  if (n < 2 || areEqual(c(x, y))) return(NA_real_)
  target <- factor(rep(seq_len(n), 2))
  squares <- anova(lm(c(x, y) ~ target + gl(2, n)))[["Mean Sq"]]
  below <- squares[1] + squares[3] + 2 * (squares[2] - squares[3]) / n
  if (below > 1e-12 * (squares[1] + squares[3])) (squares[1] - squares[3]) / below else NA_real_
}
withinSd <- function(x, y) sqrt(mean((y - x)^2) / 2)
# Interval over participants, each left out once, on the scale of `there`.
jackknife <- function(own, statistic, there, back) {
  of <- function(rows) there(statistic(rows$x, rows$y))
  people <- unique(own$participant)
  n <- length(people)
  if (n < 3) return(c(NA, NA))
  pseudo <- vapply(people, function(one) n * of(own) - (n - 1) * of(own[own$participant != one, ]), 0)
  if (!all(is.finite(pseudo))) return(c(NA, NA))
  back(of(own) + c(-1, 1) * qt(0.975, n - 1) * sd(pseudo) / sqrt(n))
}
# All participants show the same: an interval of one point would claim that the value is known exactly.
unlessPoint <- function(ends) if (isTRUE(diff(ends) > 1e-9)) ends else c(NA_real_, NA_real_)
anchorRatings <- function(question, top) {
  own <- anchorsOf(question, "repeated")
  own$x <- as.numeric(own$first)
  own$y <- as.numeric(own$second)
  icc <- intraclass(own$x, own$y)
  noise <- withinSd(own$x, own$y)
  shifts <- c(tapply(own$y - own$x, own$participant, mean))
  iccEnds <- unlessPoint(jackknife(own, intraclass, atanh, tanh))
  sdEnds <- unlessPoint(jackknife(own, withinSd, log, exp))
  ends <- testOf(shifts)$conf.int
  list(pairs = nrow(own), icc = icc, icc_ci95_low = iccEnds[1], icc_ci95_high = iccEnds[2], within_sd = noise,
       within_sd_ci95_low = sdEnds[1], within_sd_ci95_high = sdEnds[2], mean_difference = mean(shifts), ci95_low = ends[1],
       ci95_high = ends[2], ceiling_of_correlation = sqrt(max(0, icc)), ceiling_of_mean = top - noise / sqrt(2 * pi))
}
# Share of pairs that agree, each by a score of 0 to 1, with Wilson's interval and the design effect of participants.
shareOfPairs <- function(scores, participant) {
  if (length(scores) == 0) return(c(NA, NA, NA))
  pairs <- c(table(participant))
  share <- mean(scores)
  squares <- sum((c(tapply(scores, participant, sum)) - share * pairs)^2)
  effect <- max(1, squares * length(pairs) / (length(pairs) - 1) / (sum(pairs) * share * (1 - share)), na.rm = TRUE)
  n <- sum(pairs) / if (is.finite(effect)) effect else 1
  c(share, prop.test(share * n, n, correct = FALSE)$conf.int)
}
# `m` alternatives; `k` answers that are compared: 2 where only right and wrong are, and two wrong ones agree by 1/(m - 1).
anchorChoices <- function(question, m, k) {
  own <- anchorsOf(question, "repeated")
  same <- as.numeric(own$first == own$second)
  share <- shareOfPairs(same, own$participant)
  blind <- if (k < m) same * ifelse(own$first == "wrong", 1 / (m - 1), 1) else same
  kappa <- (m * shareOfPairs(blind, own$participant) - 1) / (m - 1)
  list(pairs = nrow(own), agreement = share[1], agreement_ci95_low = share[2], agreement_ci95_high = share[3],
       kappa = kappa[1], kappa_ci95_low = kappa[2], kappa_ci95_high = kappa[3],
       ceiling_of_proportion = (1 + sqrt((k - 1) * max(0, k * share[1] - 1))) / k)
}
# Kappa of words: by chance, the first word of one pair is the second word of another pair of the participant. `x`: what agrees
# beyond chance, `y`: what can, both of a participant.
kappaOfWords <- function(x, y) if (sum(y) > 0) sum(x) / sum(y) else NA_real_
anchorWords <- function(question) {
  own <- anchorsOf(question, "repeated")
  share <- shareOfPairs(as.numeric(own$first == own$second), own$participant)
  beyondChance <- function(rows) {
    n <- nrow(rows)
    agreeing <- sum(rows$first == rows$second)
    chance <- (sum(outer(rows$first, rows$second, "==")) - agreeing) / (n - 1)
    data.frame(participant = rows$participant[1], x = agreeing - chance, y = n - chance)
  }
  enough <- Filter(function(rows) nrow(rows) > 1, split(own, own$participant))
  words <- do.call(rbind, c(list(data.frame(participant = character(), x = numeric(), y = numeric())),
                            lapply(enough, beyondChance)))
  kappa <- kappaOfWords(words$x, words$y)
  ends <- unlessPoint(jackknife(words, kappaOfWords, atanh, tanh))
  list(pairs = nrow(own), agreement = share[1], agreement_ci95_low = share[2], agreement_ci95_high = share[3],
       kappa = kappa, kappa_ci95_low = ends[1], kappa_ci95_high = ends[2],
       ceiling_of_proportion = (1 + sqrt(max(0, kappa))) / 2)
}

# ---- linear mixed models ----------------------------------------------------------------------------------------------------

# One row a cell, or one row an answer.
rowsOf <- function(cells) {
  rows <- as.data.frame.table(cells, responseName = "y")
  names(rows)[1:3] <- c("participant", "fabric", "condition")
  droplevels(rows[!is.na(rows$y), ])
}
answersOf <- function(question) {
  own <- commonAnswers(question, conditions, FALSE)
  droplevels(data.frame(y = own$value, participant = factor(own$participant), fabric = factor(own$fabric),
                        condition = factor(own$condition, conditions)))
}
plainGroups <- c("participant", "fabric")
crossedGroups <- c(plainGroups, "participant_condition", "fabric_condition")

# The rows with a column for each interaction, and the groups whose variance the numbers can show.
withGroups <- function(rows, groups) {
  for (group in plainGroups)
    rows[[paste0(group, "_condition")]] <- interaction(as.integer(rows[[group]]), as.integer(rows$condition), drop = TRUE)
  isShown <- function(group) nlevels(rows[[group]]) > 1 && nlevels(rows[[group]]) < nrow(rows)
  plain <- Filter(isShown, plainGroups)
  crossed <- if (nlevels(rows$condition) > 1) Filter(isShown, intersect(paste0(plain, "_condition"), groups))
  list(rows = rows, groups = c(plain, crossed))
}
fixedOf <- function(rows) if (nlevels(rows$condition) > 1) "condition" else "1"
formulaOf <- function(response, fixed, groups)
  as.formula(paste(c(paste(response, "~", fixed), if (length(groups) > 0) paste0("(1 | ", groups, ")")), collapse = " + "))

# Fits, leaves out the groups whose standard deviation is zero, and fits again: fit(groups), and `plain` without groups. A small one
# leaves, too, where the model without it is no less likely: the likelihood is level at zero, and the optimiser stops before it.
withoutZeros <- function(groups, fit, plain, sdsOf, zero, small, noise) {
  none <- setNames(numeric(length(groups)), sprintf("sd_%s", groups))
  modelOf <- function(groups) if (length(groups) > 0) quietly(fit(groups)) else plain
  isNoWorse <- function(group) logLikelihood(modelOf(setdiff(groups, group))) > logLikelihood(model) - noise
  while (length(groups) > 0) {
    model <- modelOf(groups)
    sds <- sdsOf(model, groups)
    unit <- if (inherits(model, "lmerMod")) sigma(model) else 1
    leaves <- groups[sds <= zero * unit]
    if (length(leaves) == 0) leaves <- head(Filter(isNoWorse, groups[sds < small * unit]), 1)
    if (length(leaves) == 0)
      return(list(model = model, groups = groups, sds = sds, named = as.list(replace(none, paste0("sd_", groups), sds))))
    groups <- setdiff(groups, leaves)
  }
  list(model = plain, groups = groups, sds = numeric(), named = as.list(none))
}
logLikelihood <- function(model) {
  isLinear <- inherits(model, "lmerMod") || identical(class(model), "lm")
  c(if (isLinear) logLik(model, REML = TRUE) else logLik(model))
}
sdsOfLme4 <- function(model, groups)
  vapply(groups, function(group) attr(lme4::VarCorr(model)[[group]], "stddev")[[1]], 0)
exactly <- function(control, end, ...) control(optimizer = "bobyqa", optCtrl = list(rhoend = end, maxfun = 1e5), ...,
  check.conv.singular = "ignore", check.nobs.vs.rankZ = "ignore", check.nobs.vs.nRE = "ignore")

# The covariance matrix of each group and of the residual, for variances of 1, and the projection of the model that has them.
productsOf <- function(rows, groups)
  c(lapply(rows[groups], function(level) outer(level, level, "==") + 0), list(diag(nrow(rows))))
projectionOf <- function(x, products, sds) {
  inverse <- solve(Reduce(`+`, Map(`*`, products, sds^2)))
  half <- inverse %*% x %*% solve(crossprod(x, inverse %*% x))
  list(half = half, projection = inverse - half %*% crossprod(x, inverse))
}
# lmerTest takes second differences in the standard deviations. Near zero they need a better optimum than an optimiser finds.
# There the derivatives in the variances replace them, by their formulas.
withExactDerivatives <- function(fitted, rows, x) {
  products <- productsOf(rows, fitted$groups)
  here <- projectionOf(x, products, c(fitted$sds, sigma(fitted$model)))
  parts <- lapply(products, function(k) here$projection %*% k)
  forms <- vapply(products, function(k) c(k %*% (here$projection %*% rows$y)), numeric(nrow(x)))
  traces <- outer(seq_along(parts), seq_along(parts), Vectorize(function(i, j) sum(parts[[i]] * t(parts[[j]]))))
  fitted$model@vcov_varpar <- 2 * solve(2 * crossprod(forms, here$projection %*% forms) - traces)
  fitted$model@Jac_list <- lapply(products, function(k) crossprod(here$half, k %*% here$half))
  fitted
}
# Groups at zero where the criterion is level: a mean square equals the one that it stands on. Ratings that are all equal under a
# condition make such ties. lmerTest leaves these groups out, so that the same answers count twice: 18 degrees of freedom for 10
# participants. Here they stay, at zero.
tiedGroups <- function(fitted, rows, x, groups) {
  if (length(groups) == 0 || !any(tapply(rows$y, rows$condition, areEqual))) return(character())
  here <- projectionOf(x, productsOf(rows, fitted$groups), c(fitted$sds, sigma(fitted$model)))
  own <- c(here$projection %*% rows$y)
  isTied <- function(group) {
    product <- outer(rows[[group]], rows[[group]], "==") + 0
    expected <- sum(here$projection * product)
    abs(sum(own * (product %*% own)) - expected) <= 1e-5 * expected
  }
  Filter(isTied, groups)
}
# The model at standard deviations that are known, relative to the residual's.
modelAt <- function(formula, rows, ratios, control) {
  parts <- lme4::lFormula(formula, rows, control = control)
  deviance <- do.call(lme4::mkLmerDevfun, c(parts, list(control = control)))
  ratios <- unname(ratios[names(parts$reTrms$cnms)])
  optimum <- list(par = ratios, fval = deviance(ratios), feval = 1, conv = 0, message = NULL)
  model <- lme4::mkMerMod(environment(deviance), optimum, parts$reTrms, parts$fr)
  quietly(lmerTest:::as_lmerModLT(model, deviance))
}
hasNoVariation <- function(rows, formula) {
  rest <- lm.fit(model.matrix(formula, rows), rows$y / max(abs(rows$y), 1e-300))$residuals
  !(sum(rest^2) > 1e-24 * nrow(rows))
}
divideAlike <- function(two) nlevels(two[[1]]) == nlevels(two[[2]]) && nlevels(interaction(two, drop = TRUE)) == nlevels(two[[1]])

# Linear mixed model by restricted maximum likelihood; nothing where it does not exist.
linear <- function(rows, groups) {
  known <- withGroups(rows, groups)
  plain <- formulaOf("y", fixedOf(rows), NULL)
  pairs <- if (length(known$groups) > 1) combn(known$groups, 2, simplify = FALSE)
  if (nrow(rows) <= nlevels(rows$condition) || hasNoVariation(rows, plain) ||
      any(vapply(pairs, function(two) divideAlike(known$rows[two]), NA))) return(NULL)
  control <- exactly(lme4::lmerControl, 1e-12, calc.derivs = FALSE)
  fit <- function(groups, ...) lmerTest::lmer(formulaOf("y", fixedOf(rows), groups), known$rows, control = control, ...)
  fitted <- withoutZeros(known$groups, fit, lm(plain, rows), sdsOfLme4, 1e-4, 0.03, 1e-9)
  ratios <- fitted$sds / sigma(fitted$model)
  if (any(ratios > 50)) {  # nothing remains where the likelihood stays the same without a residual
    deviance <- fit(fitted$groups, devFunOnly = TRUE)
    theta <- lme4::getME(fitted$model, "theta")
    if (deviance(2 * theta) <= deviance(theta) + 1e-6) return(NULL)
  }
  fitted$conditions <- levels(rows$condition)
  if (nrow(rows) > 2000) return(fitted)
  x <- model.matrix(reformulate(fixedOf(rows)), rows)
  tied <- tiedGroups(fitted, known$rows, x, setdiff(known$groups, fitted$groups))
  if (length(tied) > 0) {
    fitted$groups <- c(fitted$groups, tied)
    fitted$sds <- setNames(c(fitted$sds, 0 * seq_along(tied)), fitted$groups)
    fitted$model <- modelAt(formulaOf("y", fixedOf(rows), fitted$groups), known$rows, fitted$sds / sigma(fitted$model), control)
  }
  if (length(tied) > 0 || any(ratios < 0.1)) withExactDerivatives(fitted, known$rows, x) else fitted
}

# A weighted sum of the fixed effects.
meanOf <- function(fitted, weights) {
  model <- fitted$model
  test <- if (!inherits(model, "lm")) as.list(quietly(lmerTest::contest1D(model, weights)))[c("Estimate", "Std. Error", "df")]
          else list(sum(weights * coef(model)), sqrt(c(weights %*% vcov(model) %*% weights)), model$df.residual)
  setNames(test, c("estimate", "se", "df"))
}
# Ends of the interval of 95 % or 90 %, cut at these limits.
interval <- function(mean, percent, limits = c(-Inf, Inf)) {
  if (is.null(mean$se)) return(NULL)
  ends <- mean$estimate + c(-1, 1) * qt(0.5 + percent / 200, mean$df) * mean$se
  setNames(as.list(pmin(limits[2], pmax(limits[1], ends))), paste0("ci", percent, c("_low", "_high")))
}
twoSided <- function(mean) if (!is.null(mean$se)) 2 * pt(-abs(mean$estimate / mean$se), mean$df)
oneSided <- function(mean, mu, isLess)
  if (!is.null(mean$se)) pt((mean$estimate - mu) / mean$se, mean$df, lower.tail = isLess)

modelCells <- function(question) commonCells(question, conditions, needsAll = FALSE)
linearOf <- function(question) once(paste("linear", question), linear(rowsOf(modelCells(question)), crossedGroups))
linearModel <- function(question) {
  fitted <- linearOf(question)
  n <- list(n = sum(!is.na(modelCells(question))))
  if (is.null(fitted)) return(n)
  n <- c(n, fitted$named, list(sd_residual = sigma(fitted$model)))
  if (length(fitted$conditions) < 2) return(n)
  # Sequential contrasts: where cells are missing, the degrees of freedom depend on the contrasts.
  isPlain <- inherits(fitted$model, "lm")
  test <- if (isPlain) anova(fitted$model) else quietly(anova(fitted$model, type = 1))
  c(n, list(f = test[["F value"]][1], df1 = length(fitted$conditions) - 1, df2 = if (isPlain) test$Df[2] else test$DenDF,
                 p = test[["Pr(>F)"]][1]))
}
modelContrast <- function(question, a, b) {
  fitted <- linearOf(question)
  if (is.null(fitted)) return(list())
  mean <- meanOf(fitted, replace((fitted$conditions == a) - (fitted$conditions == b), 1, 0))
  c(mean, list(t = mean$estimate / mean$se, p = twoSided(mean)), interval(mean, 95))
}

# ---- claims: means of participants x fabrics --------------------------------------------------------------------------------

# The participants and fabrics that have a number.
present <- function(cells, of = cells) {
  isMet <- function(margin) apply(!is.na(of), margin, any)
  if (length(of) > 0) cells[isMet(1), isMet(2), , drop = FALSE] else cells
}
isTestable <- function(x) !areEqual(without(x)) && nrow(x) > 1
# Without a test there is an estimate, unless there is no number.
untested <- function(x)
  if (all(is.na(x))) list() else list(estimate = if (areEqual(without(x))) without(x)[1] else mean(participantMeans(x)))
ofTheseFabrics <- function(x) {
  test <- if (isTestable(x)) testOf(participantMeans(x))
  if (is.null(test)) untested(x) else list(estimate = test$estimate[[1]], se = test$stderr, df = test$parameter[[1]])
}
# Upper limit of the degrees of freedom where neither participants nor fabrics seem to vary.
mostDegrees <- function(x) {
  rows <- rowsOf(x)
  effects <- lapply(plainGroups, function(group) ave(rows$y, rows[[group]]) - mean(rows$y))
  dfs <- dim(x)[1:2] - 1
  residual <- sum((rows$y - mean(rows$y) - effects[[1]] - effects[[2]])^2) / max(1, nrow(rows) - sum(dfs) - 1)
  ratios <- vapply(effects, function(effect) sum(effect^2), 0) / dfs / residual
  1.2 / sum(ratios^6 / dfs)
}
# The limit applies where answers are missing, and where all conditions together show an interaction.
isLimited <- function(question) once(paste("limited", question), {
  cells <- present(cellsOf(question))
  formula <- y ~ condition * (participant + fabric)
  claims <- unique(expected[expected$section == "claims_fabrics_like_these" & expected$question == question, c("a", "b")])
  anyNA(cells) || any(unlist(mapply(isOther, question, claims$a, claims$b))) || any(dim(cells) < 2) ||
    hasNoVariation(rowsOf(cells), formula) ||
    any(anova(lm(formula, rowsOf(cells)))[c("condition:participant", "condition:fabric"), "Pr(>F)"] < 0.05)
})
# Mean of `x` by the model of `rows`.
likeThese <- function(x, rows, weights, groups, limited) {
  # Where participants and fabrics reproduce every difference, nothing is claimed.
  isDetermined <- !anyNA(x) && isTestable(x) && ncol(x) > 1 && hasNoVariation(rowsOf(x), y ~ participant + fabric)
  fitted <- if (isTestable(x) && ncol(x) > 1 && !isDetermined) orNothing(linear(rows, groups))
  if (is.null(fitted)) return(untested(x))
  mean <- meanOf(fitted, weights)
  if (limited && !any(fitted$sds[tail(groups, 2)] > 0, na.rm = TRUE)) mean$df <- min(mean$df, mostDegrees(x)[mostDegrees(x) > 0], na.rm = TRUE)
  mean
}
# The difference of two conditions, or the share correct under one.
claim <- function(question, a, b, low, high, ofThese) {
  isShare <- b == ""
  cells <- if (isShare) cellsOf(question) else commonCells(question, c(a, b))
  whole <- if (isShare) under(cells, a) else under(cells, a) - under(cells, b)
  x <- present(whole)
  # Ratings without gaps: the model of both conditions, whose sums show the residual, too. Where the ratings of one are all equal,
  # sums and differences are the same numbers. Where repetitions are left out, the sums differ with them.
  both <- if (!question %in% choices && !anyNA(x) && !isOther(question, a, b)) present(cells[, , c(b, a), drop = FALSE], whole)
  if (!is.null(both) && (areEqual(both[, , 1]) || areEqual(both[, , 2]))) both <- NULL
  mean <- if (ofThese) ofTheseFabrics(x)
          else if (is.null(both)) likeThese(x, rowsOf(x), 1, plainGroups, isShare || isLimited(question))
          else likeThese(x, rowsOf(both), c(0, 1), crossedGroups, isLimited(question))
  if (isShare) return(c(mean, list(p = oneSided(mean, low, FALSE)), interval(mean, 95, c(0, 1))))
  tost <- if (!is.na(low) && !is.null(mean$se)) max(oneSided(mean, low, FALSE), oneSided(mean, high, TRUE))
  c(mean, list(p = twoSided(mean), p_equivalence = tost), interval(mean, 95), interval(mean, 90))
}

# ---- logistic and ordinal mixed models, by Laplace's approximation ----------------------------------------------------------

# The better of two fits, as there may be several maxima. lme4's default tolerance would stop one step before the maximum.
binary <- function(rows, fixed, groups) {
  fit <- function(groups) {
    models <- lapply(c(1, 5), function(start) quietly(lme4::glmer(formulaOf("y", fixed, groups), rows, binomial,
      start = rep(start, length(groups)), control = exactly(lme4::glmerControl, 1e-10, tolPwrss = 1e-13))))
    models[[which.max(vapply(models, logLik, 0))]]
  }
  plain <- glm(formulaOf("y", fixed, NULL), binomial, rows, control = list(epsilon = 1e-13))
  fitted <- withoutZeros(groups, fit, plain, sdsOfLme4, 1e-3, 0.1, 1e-8)
  effects <- if (inherits(fitted$model, "glm")) coef(fitted$model) else lme4::fixef(fitted$model)
  c(fitted, list(effects = effects, covariance = as.matrix(vcov(fitted$model))))
}
# The steps of clmm's own second differences are so small that some standard errors are off by 1 %. The steps here are 0.1.
cumulative <- function(rows, fixed, groups) {
  fit <- function(groups, ...) ordinal::clmm(formulaOf("factor(y)", fixed, groups), data = rows, ...,
    control = ordinal::clmm.control(gradTol = 1e-7, maxIter = 200, maxLineIter = 200))
  plain <- quietly(ordinal::clm(formulaOf("factor(y)", fixed, NULL), data = rows))
  # clmm sorts groups by their number of levels, but names those of equal number in the wrong order.
  sdsOf <- function(model, groups) {
    if (length(groups) == 1) return(setNames(attr(ordinal::VarCorr(model)[[1]], "stddev")[[1]], groups))
    sorted <- groups[order(-vapply(groups, function(group) nlevels(rows[[group]]), 0))]
    setNames(abs(tail(model$optRes$par, length(groups))), sorted)[groups]
  }
  fitted <- withoutZeros(groups, fit, plain, sdsOf, 1e-3, 0.1, 1e-8)
  covariance <- vcov(fitted$model)
  if (length(fitted$groups) > 0) {
    found <- fitted$model$optRes$par
    start <- quietly(fit(fitted$groups, doFit = FALSE))
    minusLogLikelihood <- if (length(fitted$groups) > 1) ordinal:::getNLA else ordinal:::getNLA.ssr
    near <- function(one) minusLogLikelihood(start, found + one - 1)
    covariance[] <- solve(quietly(numDeriv::hessian(near, rep(1, length(found)))))
  }
  c(fitted, list(effects = fitted$model$beta, covariance = covariance))
}
# Whether conditions have finite log odds. Those with all answers in the lowest or the highest category have not. Without them the
# next category may become the lowest.
finiteConditions <- function(low, high) {
  isFinite <- setNames(rep(TRUE, length(low)), names(low))
  repeat {
    isEnd <- isFinite & low == high & low %in% quietly(c(min(low[isFinite]), max(high[isFinite])))
    if (!any(isEnd)) return(isFinite)
    isFinite[isEnd] <- FALSE
  }
}
# The model of the conditions with finite log odds, and for choices the model without condition. Other conditions add nothing to
# the likelihood. There is no model where no condition has ratings on both sides of a category.
laplaceFit <- function(rows, groups, isChoice) {
  if (nlevels(rows$condition) < 2 || areEqual(rows$y)) return(NULL)
  low <- tapply(rows$y, rows$condition, min)
  high <- tapply(rows$y, rows$condition, max)
  isFinite <- finiteConditions(low, high)
  known <- withGroups(rows, groups)
  rest <- droplevels(known$rows[isFinite[as.integer(rows$condition)], ])
  values <- sort(unique(rest$y))
  if (!all(vapply(values[-c(1, length(values))], function(y) any(isFinite & low < y & high > y), NA))) return(NULL)
  isBinary <- length(values) < 3
  if (isBinary) rest$y <- as.numeric(rest$y > values[1])
  fit <- function(rows, fixed) {
    # Of groups that divide the answers in the same way only the sum of the variances is known.
    pairs <- if (length(known$groups) > 1) combn(known$groups, 2, simplify = FALSE)
    alike <- Filter(function(two) divideAlike(droplevels(rows[two])), pairs)
    groups <- setdiff(known$groups, vapply(alike, `[`, "", 2))
    fitted <- if (isBinary) binary(rows, fixed, groups) else cumulative(rows, fixed, groups)
    fitted$named[sprintf("sd_%s", unique(unlist(alike)))] <- NULL
    if (all(fitted$sds < 50)) fitted  # otherwise the groups reproduce almost every answer
  }
  full <- if (any(isFinite)) fit(rest, fixedOf(rest)) else list()
  if (!is.null(full)) list(full = full, null = if (isChoice) fit(known$rows, "1"), isFinite = isFinite)
}
logisticOf <- function(question, groups)
  once(paste("logistic", length(groups), question), laplaceFit(answersOf(question), groups, TRUE))
ordinalOf <- function(question, unit) once(paste("ordinal", question), {
  rows <- answersOf(question)
  rows$y <- floor(rows$y / unit + 0.5 + 1e-9)  # to multiples of the unit, halves up
  laplaceFit(rows, plainGroups, FALSE)
})
# Numbers of a whole model; log odds of `a` minus those of the reference; without a reference, log odds of `a`.
laplace <- function(question, a, reference, fitted) {
  n <- list(n = nrow(answersOf(question)))
  if (is.null(fitted)) return(n)
  if (a == "") {
    model <- fitted$full$model
    found <- c(n, fitted$full$named, list(log_likelihood = if (is.null(model)) 0 else c(logLik(model))))
    if (is.null(fitted$null)) return(found)
    chi2 <- max(0, 2 * (found$log_likelihood - c(logLik(fitted$null$model))))
    df <- length(fitted$isFinite) - 1
    return(c(found, list(chi2 = chi2, df = df, p = pchisq(chi2, df, lower.tail = FALSE))))
  }
  if (!fitted$isFinite[1] || !fitted$isFinite[a]) return(list())
  place <- if (reference == "") "(Intercept)" else paste0("condition", a)
  estimate <- fitted$full$effects[[place]]
  se <- sqrt(fitted$full$covariance[place, place])
  ends <- exp(estimate + c(-1, 1) * qnorm(0.975) * se)
  list(estimate = estimate, se = se, odds_ratio = exp(estimate), p = 2 * pnorm(-abs(estimate / se)), ci95_low = ends[1],
       ci95_high = ends[2])
}

# ---- the numbers of expected.csv --------------------------------------------------------------------------------------------

kinds <- c(linear = "^linear_|^model_|_fabrics_like_these$", logistic = "^logistic_", ordinal = "^ordinal_")
packages <- list(linear = c("lme4", "lmerTest"), logistic = "lme4", ordinal = c("lme4", "ordinal"))

computed <- function(g) {
  switch(g$section,
    matches = matches(g$question, g$a, g$low),
    ratings = ratings(g$question, g$a),
    comparison = comparison(g$question, g$a, g$b),
    equivalence = equivalence(g$question, g$a, g$b, g$low, g$high),
    above_chance_these_fabrics = , above_chance_fabrics_like_these = , claims_these_fabrics = , claims_fabrics_like_these =
      claim(g$question, g$a, g$b, g$low, g$high, grepl("_these_fabrics$", g$section)),
    linear_model = linearModel(g$question),
    model_contrast = modelContrast(g$question, g$a, g$b),
    logistic_model = laplace(g$question, g$a, g$b, logisticOf(g$question, plainGroups)),
    logistic_model_crossed = laplace(g$question, g$a, g$b, logisticOf(g$question, crossedGroups)),
    ordinal_model = laplace(g$question, g$a, g$b, ordinalOf(g$question, g$low)),
    anchor_floor = orNothing(anchorFloor(g$question)),
    anchor_ratings = orNothing(quietly(anchorRatings(g$question, g$high))),
    anchor_choices = orNothing(quietly(anchorChoices(g$question, g$low, g$high))),
    anchor_words = orNothing(quietly(anchorWords(g$question))),
    stop("expected.csv has an unknown section: ", g$section))
}

groups <- expected[!duplicated(expected[c("section", "question", "a", "b")]), ]
groups$kind <- ""
for (kind in names(kinds)) groups$kind[grepl(kinds[[kind]], groups$section)] <- kind
contrastCounts <- table(groups$question[groups$section == "claims_fabrics_like_these"])

# Why a group of numbers is left out; empty where it is computed.
whyLeftOut <- function(g) {
  if (g$kind == "") return("")
  lacking <- Filter(function(package) !requireNamespace(package, quietly = TRUE), packages[[g$kind]])
  debian <- paste0("r-cran-", tolower(lacking), collapse = " ")
  if (length(lacking) > 0) return(sprintf("needs %s (apt-get install %s)", paste(lacking, collapse = " and "), debian))
  isLarge <- sum(answers$question == g$question) > mostAnswers[[g$kind]] ||
    (g$section == "claims_fabrics_like_these" && contrastCounts[[g$question]] > mostContrasts)
  if (isLarge) return("takes longer than minutes (Rscript analysis.R all)")
  if (g$section == "logistic_model_crossed" && sum(answers$question == g$question) < 20)
    return("fewer than 20 answers: the likelihood has several maxima, and optimisers find different ones")
  if (g$kind == "ordinal" && 2 %in% lengths(lapply(answersOf(g$question)[plainGroups], levels)))
    "clmm needs at least 3 participants and 3 fabrics" else ""
}
groups$why <- vapply(seq_len(nrow(groups)), function(i) whyLeftOut(groups[i, ]), "")
found <- lapply(seq_len(nrow(groups)), function(i) if (groups$why[i] == "") computed(groups[i, ]))
# Holm's correction over all comparisons of a question, and over each family of claims.
for (family in split(seq_len(nrow(groups)), paste(groups$section, groups$question)))
  for (p in c("p", "p_equivalence")) {
    values <- vapply(family, function(i) if (is.null(found[[i]][[p]])) NA_real_ else found[[i]][[p]], 0)
    for (k in which(!is.na(values))) found[[family[k]]][[paste0(p, "_holm")]] <- p.adjust(values, "holm")[k]
  }

keyOf <- function(rows) paste(rows$section, rows$question, rows$a, rows$b, sep = "\r")
place <- match(keyOf(expected), keyOf(groups))
here <- vapply(seq_along(place), function(i) {
  value <- found[[place[i]]][[expected$quantity[i]]]
  if (is.null(value) || is.na(value)) NA_real_ else value
}, 0)
# The difference from the report in units of the tolerance; beyond 1 the numbers differ.
deviation <- function(i) {
  kind <- groups$kind[place[i]]
  name <- expected$quantity[i]
  both <- c(here[i], expected$value[i])
  if (anyNA(both)) return(if (all(is.na(both))) 0 else Inf)
  if (both[1] == both[2]) return(0)
  tolerance <- if (kind == "" || name == "n") 1e-7 else if (name == "log_likelihood") 1e-6 else tolerances[[kind]]
  isLog <- kind != "" && grepl("^(p|p_.*|odds_ratio)$", name) || (kind == "ordinal" && grepl("^ci", name))
  isSd <- grepl("^sd_", name)
  if (isLog) both <- log(both)
  if (isSd) both <- both^2
  own <- found[[place[i]]]
  least <- if (kind == "") 0 else if (isLog || name %in% c("t", "f", "chi2")) 1
           else if (isSd) (if (is.null(own$sd_residual)) 1 else own$sd_residual^2) / 100
           else if (grepl("^(estimate|ci)", name)) own$se
  abs(diff(both)) / (1e-9 + tolerance * max(abs(both[2]), least))
}
isCompared <- groups$why[place] == ""
isSame <- vapply(seq_along(place), function(i) !isCompared[i] || deviation(i) <= 1, NA)

for (section in unique(expected$section[isCompared])) {
  own <- expected$section == section & isCompared
  cat(sprintf("%s: %d of %d\n", section, sum(isSame[own]), sum(own)))
}
for (i in head(which(!isSame), 20))
  cat(sprintf("differs: %s %s %s %s %s: report %.15g, here %.15g\n", expected$section[i], expected$question[i], expected$a[i],
              expected$b[i], expected$quantity[i], expected$value[i], here[i]))
named <- function(names) paste(unique(names), collapse = ", ")
for (left in split(groups, groups$why)) if (left$why[1] != "")
  cat("left out: ", named(left$section), " of ", named(left$question), ": ", left$why[1], "\n", sep = "")
cat("left out: d', ANOVA, Friedman and Cochran tests, effect sizes, agreement, R squared, Bayes factors, intervals over trials\n")
cat("left out: standard errors of logistic_model, speed, order effects, groups, signals, times\n")
cat(sprintf("reproduced: %d of %d\n", sum(isSame[isCompared]), sum(isCompared)))
quit(status = if (all(isSame)) 0 else 1)

# Computes the main tables of the report again, with base R alone, and compares them with expected.csv.
#   Rscript analysis.R          in this folder
# Reads answers.csv (one row an answer) and expected.csv (one row a number of the report); codebook.csv explains both.
# Left out: mixed and ordinal models, bootstrap intervals, Bayes factors, order effects, signals, times.

answers <- read.csv("answers.csv", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = "")
expected <- read.csv("expected.csv", colClasses = "character", check.names = FALSE, encoding = "UTF-8", na.strings = "")
answers$value <- as.numeric(ifelse(is.na(answers$correct), answers$rating, answers$correct))
answers <- answers[!is.na(answers$value), ]

# One row a participant, one column a condition.
meansOf <- function(question) {
  own <- answers[answers$question == question, ]
  tapply(own$value, list(own$participant, own$condition), mean)
}

column <- function(means, condition) if (condition %in% colnames(means)) means[, condition] else rep(NA_real_, nrow(means))

# A test that cannot be done gives no number.
orNothing <- function(test) tryCatch(test, error = function(e) NULL)
areEqual <- function(x) length(x) < 2 || all(x == x[1])
testOf <- function(x, ...) if (areEqual(x)) NULL else t.test(x, ...)

# The interval of equal numbers is a point.
meanInterval <- function(x) if (length(x) > 1 && areEqual(x)) rep(x[1], 2) else testOf(x)$conf.int

matches <- function(question, condition, chance) {
  value <- answers$value[answers$question == question & answers$condition == condition]
  test <- orNothing(binom.test(sum(value), length(value), chance, alternative = "greater"))
  means <- column(meansOf(question), condition)
  shares <- testOf(means[!is.na(means)], mu = chance)
  list(correct = sum(value), trials = length(value), proportion = mean(value), p_chance = test$p.value,
       p_chance_participants = shares$p.value)
}

ratings <- function(question, condition) {
  value <- answers$value[answers$question == question & answers$condition == condition]
  means <- column(meansOf(question), condition)
  interval <- meanInterval(means[!is.na(means)])
  list(n = length(value), mean = mean(value), sd = sd(value), ci95_low = interval[1], ci95_high = interval[2])
}

differences <- function(question, a, b) {
  means <- meansOf(question)
  d <- column(means, a) - column(means, b)
  d[!is.na(d)]
}

comparison <- function(question, a, b) {
  d <- differences(question, a, b)
  test <- testOf(d)
  list(n = length(d), mean_difference = mean(d), statistic = unname(test$statistic), df = unname(test$parameter),
       p = test$p.value, ci95_low = test$conf.int[1], ci95_high = test$conf.int[2],
       d_z = if (is.null(test)) NULL else mean(d) / sd(d))
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

groups <- expected[!duplicated(expected[c("section", "question", "a", "b")]), ]
found <- list()
for (i in seq_len(nrow(groups))) {
  g <- groups[i, ]
  found[[i]] <- switch(g$section,
    matches = matches(g$question, g$a, as.numeric(g$low)),
    ratings = ratings(g$question, g$a),
    comparison = comparison(g$question, g$a, g$b),
    equivalence = equivalence(g$question, g$a, g$b, as.numeric(g$low), as.numeric(g$high)),
    stop("expected.csv has an unknown section: ", g$section))
}
# Holm's correction over all comparisons of a question.
for (question in unique(groups$question)) {
  at <- which(groups$section == "comparison" & groups$question == question)
  p <- vapply(at, function(i) if (is.null(found[[i]]$p)) NA_real_ else found[[i]]$p, numeric(1))
  adjusted <- p.adjust(p, "holm")
  for (k in seq_along(at)) found[[at[k]]]$p_holm <- adjusted[k]
}

keyOf <- function(rows) paste(rows$section, rows$question, rows$a, rows$b, sep = "\r")
place <- match(keyOf(expected), keyOf(groups))
same <- logical(nrow(expected))
computed <- rep(NA_real_, nrow(expected))
for (i in seq_len(nrow(expected))) {
  value <- found[[place[i]]][[expected$quantity[i]]]
  if (!is.null(value) && is.finite(value)) computed[i] <- value
  reported <- as.numeric(expected$value[i])
  same[i] <- if (is.na(reported)) is.na(computed[i])
             else !is.na(computed[i]) && abs(computed[i] - reported) <= 1e-9 + 1e-7 * abs(reported)
}

for (section in unique(expected$section)) {
  own <- expected$section == section
  cat(sprintf("%s: %d of %d\n", section, sum(same[own]), sum(own)))
}
for (i in head(which(!same), 20))
  cat(sprintf("differs: %s %s %s %s %s: report %s, here %.15g\n", expected$section[i], expected$question[i], expected$a[i],
              ifelse(is.na(expected$b[i]), "", expected$b[i]), expected$quantity[i], expected$value[i], computed[i]))
cat("left out: mixed and ordinal models, bootstrap intervals, Bayes factors, order effects, signals, times\n")
cat(sprintf("reproduced: %d of %d\n", sum(same), nrow(expected)))
quit(status = if (all(same)) 0 else 1)

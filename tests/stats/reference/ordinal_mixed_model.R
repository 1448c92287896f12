# Numbers of ordinal::clmm for tests/stats/ordinal_mixed_model_test.cpp: Rscript tests/stats/reference/ordinal_mixed_model.R
# (Debian 12: R 4.2.2, r-cran-ordinal 2022.11-16)
suppressMessages(library(ordinal))
y <- as.integer(strsplit("435646557326567633566757232423536432656574653256244312455325", "")[[1]])
i <- 0:59
study <- data.frame(y, c = factor(i %% 3 + 1), p = factor(i %/% 12), f = factor(i %/% 3 %% 4))
show <- function(title, rating) {
  rows <- transform(study, y = factor(rating, 1:7))
  control <- clmm.control(gradTol = 1e-7, maxIter = 500, maxLineIter = 200)
  m <- tryCatch(suppressWarnings(clmm(y ~ c + (1 | p) + (1 | f), rows, control = control)), error = conditionMessage)
  if (is.character(m)) return(cat(title, ": ", m, "\n", sep = ""))
  se <- tryCatch(sqrt(diag(vcov(m))), error = function(e) NA)
  numbers <- function(x) paste(sprintf("%.6f", x), collapse = ", ")
  cat(sprintf("%s: logLik %.9f\n  thresholds %s: %s\n  effects %s\n  sds %s\n  se %s\n", title, logLik(m),
              paste(names(m$alpha), collapse = " "), numbers(m$alpha), numbers(m$beta),
              numbers(sapply(VarCorr(m), attr, "stddev")), numbers(se)))
}
show("seven levels", y)
show("4 is never used", ifelse(y == 4, 5, y))
show("1 and 7 are never used", pmin(6, pmax(2, y)))
show("condition 3 is always 1", ifelse(study$c == 3, 1, y))
show("conditions are 3, 6 and 3", ifelse(study$c == 2, 6, 3))
show("the rating is the person", i %/% 12 + 1)

# How often the difference of two conditions is claimed where all ratings under one are equal: Rscript equal_ratings.R
# Ten participants, seven fabrics, 10,000 studies. "pooled": sums and differences share their mean squares, as in the model of
# both conditions by lmerTest. "differences": the mean squares of the differences alone.
participants <- 10
fabrics <- 7
studies <- 10000

# Pools the smallest mean square with the one above it (a row of `strata`) until none is below; then Satterthwaite's test.
pOf <- function(strata, mean) {
  repeat {
    size <- strata$squares / strata$df
    below <- which(!is.na(strata$above) & size <= size[strata$above] * (1 + 1e-5))
    if (length(below) == 0) break
    one <- below[which.min(size[below])]
    into <- strata$above[one]
    for (column in c("squares", "df", "weight")) strata[into, column] <- strata[into, column] + strata[one, column]
    strata$weight[one] <- 0
    strata$above[strata$above %in% one] <- into
    strata$above[one] <- NA
  }
  parts <- strata$weight * strata$squares / strata$df
  2 * pt(-abs(mean) / sqrt(sum(parts) / (participants * fabrics)), sum(parts)^2 / sum(parts^2 / strata$df))
}
for (fabricSd in c(0, 0.5)) for (difference in c(0, 0.8)) {
  set.seed(1)
  p <- replicate(studies, {
    y <- round(5.5 + difference + matrix(rnorm(participants, 0, 0.8), participants, fabrics) +
      rep(rnorm(fabrics, 0, fabricSd), each = participants) + rnorm(participants * fabrics, 0, 0.92), 1) - 5.5
    ofPeople <- fabrics * sum((rowMeans(y) - mean(y))^2)
    ofFabrics <- participants * sum((colMeans(y) - mean(y))^2)
    rest <- sum((y - mean(y))^2) - ofPeople - ofFabrics
    df <- c((participants - 1) * (fabrics - 1), participants - 1, fabrics - 1)
    alone <- data.frame(squares = c(rest, ofPeople, ofFabrics), df, weight = c(-1, 1, 1), above = c(NA, 1, 1))
    both <- rbind(alone, alone[2:3, ])
    both[1, c("squares", "df")] <- 2 * both[1, c("squares", "df")]
    both$weight[4:5] <- 0
    both$above[4:5] <- 2:3
    c(pooled = pOf(both, mean(y)), differences = pOf(alone, mean(y)))
  })
  for (way in rownames(p)) {
    rejected <- sum(p[way, ] < 0.05)
    interval <- 100 * binom.test(rejected, studies)$conf.int
    cat(sprintf("fabrics of SD %g, difference %g, %-11s %5.2f %% [%.2f, %.2f]\n", fabricSd, difference, way,
                100 * rejected / studies, interval[1], interval[2]))
  }
}

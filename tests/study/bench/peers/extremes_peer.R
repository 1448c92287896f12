# R on the extreme inputs of `vis2hap bench extremes`: see extremes_peer.py for the lines that come and go.
operations <- list(
    "one sample t" = function(x, mu) t.test(x, mu = mu)$statistic,
    "one sample p" = function(x, mu) t.test(x, mu = mu)$p.value,
    "one sample high" = function(x, mu) t.test(x, mu = mu)$conf.int[2],
    "mean" = function(x) mean(x),
    "variance" = function(x) var(x),
    "standard deviation" = function(x) sd(x),
    "autocorrelation" = function(x) acf(x, lag.max = 1, plot = FALSE)$acf[2],
    "mean absolute error" = function(a, b) mean(abs(a - b)),
    "anova F" = function(...) {
        groups <- list(...)
        summary(aov(unlist(groups) ~ factor(rep(seq_along(groups), lengths(groups)))))[[1]][1, 4]
    },
    "repeated measures F" = function(...) {
        rows <- do.call(rbind, list(...))
        y <- as.vector(rows)
        block <- factor(rep(seq_len(nrow(rows)), ncol(rows)))
        condition <- factor(rep(seq_len(ncol(rows)), each = nrow(rows)))
        anova(lm(y ~ block + condition))["condition", "F value"]
    },
    "log p of t" = function(x) log(2) + pt(x[1], x[2], lower.tail = FALSE, log.p = TRUE),
    "log p of count" = function(x) pbinom(x[1] - 1, x[2], x[3], lower.tail = FALSE, log.p = TRUE),
    "p of count" = function(x) binom.test(x[1], x[2], x[3], alternative = "greater")$p.value,
    "clopper high" = function(x) binom.test(x[1], x[2])$conf.int[2],
    "wilcoxon p" = function(x, y) wilcox.test(x, y, paired = TRUE, exact = TRUE)$p.value,
    "tost p" = function(x, bounds) max(t.test(x, mu = bounds[1], alternative = "greater")$p.value,
                                       t.test(x, mu = bounds[2], alternative = "less")$p.value),
    "friedman q" = function(...) friedman.test(do.call(rbind, list(...)))$statistic)

answer <- function(work, rows) {
    start <- Sys.time()
    found <- tryCatch(as.numeric(suppressWarnings(do.call(work, rows)))[1], error = function(fault) conditionMessage(fault))
    ms <- 1000 * as.numeric(difftime(Sys.time(), start, units = "secs"))
    if (is.character(found)) return(c("refused", gsub("[[:space:]]+", " ", found), ms))
    if (is.na(found)) return(c("refused", "the answer is NaN", ms))
    c("number", sub("Inf", "inf", sprintf("%.17g", found)), ms)
}
for (line in readLines(commandArgs(TRUE)[1])) {
    fields <- strsplit(line, "\t")[[1]]
    work <- operations[[fields[2]]]
    if (is.null(work)) next
    rows <- lapply(strsplit(fields[-(1:2)], " "), as.numeric)
    rows <- lapply(rows, unname)
    answer(work, rows)
    cat(c(fields[1], "R", answer(work, rows)), sep = "\t")
    cat("\n")
}

// The files of an export: answers after the unblinding, before it progress and rounded means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database/keys.h"

namespace study::exports {

struct ExportForm {
    std::string format;        ///< "csv", "json", "script" or "psych-ds", which writes a data set by that specification
    bool withLog = false;      ///< the log, too: log.csv, acts.csv and log.txt, for "psych-ds" in data/raw
    bool withSamples = false;  ///< samples of the finger, too: finger_samples.csv, beside the log; unblinded studies only
    /// Leaves out days, notes, words and answers of who withdrew, and adds LICENSE.txt and CITATION.cff; "csv" and "psych-ds" of
    /// unblinded studies only.
    bool isPublic = false;
    std::string licence = {};  ///< SPDX identifier
    std::vector<std::string> authors = {};
    bool withMeans = true;  ///< rounded means of a blinded study, where its key is known
};

struct WrittenExport {
    std::string whyNoMeans = {};            ///< a sentence where a blinded study has no means although its key is known
    std::vector<std::string> removed = {};  ///< scripts of earlier exports, of participants whose answers were erased since
    std::vector<std::string> left = {};     ///< files of the names of an export that lay there before, and stayed as they were
};

/// `out`: a folder that need not exist; a public export and "psych-ds" take a new or empty one only.
WrittenExport writeExport(const database::StudyStore& store, const std::filesystem::path& out, const ExportForm& form,
                          const database::Passphrase& passphrase);

}  // namespace study::exports

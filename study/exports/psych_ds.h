// A data set by the specification Psych-DS (https://psych-ds.github.io): the names of its data files and the texts beside them.
// The tables themselves are those of the other exports; write_export.cpp writes them.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"
#include "study/exports/codebook.h"
#include "study/exports/write_export.h"

namespace study::exports {

/// Version of the specification that data sets follow.
inline constexpr const char* psychDsVersion = "1.5.1";

/// What the texts of a data set say.
struct PsychDsDataset {
    std::string study;                ///< name of the study, as it was typed
    std::string description;          ///< what the tables hold, in whole sentences
    std::string rowKey;               ///< which columns name one row, as a sentence; empty where there are no answers
    std::vector<std::string> tables;  ///< "answers", "participants"
    std::vector<CodebookColumn> columns;
    std::vector<std::string> limits;   ///< sentences that every report of the study shows
    std::vector<std::string> changes;  ///< what a reader must know of the history, one line each
    std::string logHead, day;          ///< day of the export: "2026-11-25"
    bool hasMaterials = false, hasRawData = false;
    bool isPublic = false;     ///< the next two are there, and LICENSE.txt and CITATION.cff
    std::string licence = {};  ///< SPDX identifier
    std::vector<std::string> authors = {};
};

/// Value of a keyword in a file name: ASCII letters and digits only. A short name of such characters stays as it is. Any other
/// name keeps those that it has, with a capital where others stood before, and a hash of the name follows: "user study" becomes
/// "userStudyx" and 8 digits. Different names have different values, as far as the hash tells them apart.
std::string keywordValue(const std::string& name);

/// "study-NAME_data.csv" for the answers, "study-NAME_description-TABLE_data.csv" for other tables. `table`: lower-case letters.
std::string dataFileName(const std::string& study, const std::string& table);

/// What the store says about the data set. `columns`: those of its tables.
PsychDsDataset psychDsDataset(const database::StudyStore& store, const database::StudyFacts& facts, const ExportForm& form,
                              const std::vector<CodebookColumn>& columns);

/// dataset_description.json: JSON-LD with the vocabulary of schema.org. No "<" stands in it, so that it fits into a web page.
std::string datasetDescription(const PsychDsDataset& dataset);

/// README.md, CHANGES.md and .psychds-ignore, which names the files that the specification does not know.
std::string datasetReadme(const PsychDsDataset& dataset);
std::string datasetChanges(const PsychDsDataset& dataset);
std::string datasetIgnoreList(const PsychDsDataset& dataset);

}  // namespace study::exports

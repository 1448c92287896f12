// What an operator with a shell sees of a study: the trials, their trays, and every readable value beside each of them. All of it
// is read by SQL and from files, as an attacker reads it. The answers of the participants are left out: no seal can hide them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "study/leaks/text_table.h"

namespace study::leaks {

struct SeenTrial {
    int slot = 0;             ///< from 1
    int number = 0;           ///< in the list of the slot, from 1
    int phase = 0;            ///< index into Protocol::phases
    std::string participant;  ///< empty while nobody has the slot
    std::string code;         ///< of the presentation
    std::vector<std::string> tray;
    std::string instruction = {};  ///< id; its list of trials is drawn on its own

    bool isInListOf(const SeenTrial& other) const
    {
        return slot == other.slot && phase == other.phase && instruction == other.instruction;
    }
};

struct SeenStudy {
    protocols::Protocol protocol;
    std::uint64_t publicSeed = 0;
    std::vector<std::string> fabrics;
    std::vector<std::map<std::string, std::string>> pieceCodes;  ///< [slot - 1]: fabric -> code on its piece
    std::vector<SeenTrial> trials;                               ///< by slot and number
    std::size_t trialsOfStudy = 0;                               ///< of all slots, also of those that are left out
    std::size_t slotsOfStudy = 0;

    /// True where the tray holds the true fabric alone, as in phases of ratings.
    bool showsTruth(const SeenTrial& trial) const;
    bool isChoice(const SeenTrial& trial) const;
};

/// Reads the tables of study.db. Of a study with more than `most` trials it takes whole slots in neighbouring pairs that are
/// spread evenly from the first slot to the last, as many as `most` allows, and at least one pair. Pairs serve the guessers who
/// learn from slots of one parity for the other.
SeenStudy seenStudy(const std::vector<TextTable>& database, std::size_t most = 4000);

/// One readable value beside each trial.
struct Feature {
    std::string name;
    std::vector<std::string> values;  ///< [trial of SeenStudy]; empty: none
};

/// Every column of every table that names a trial by slot or participant and number, by presentation code, or through the log.
/// With every column of other tables that such a value leads to (joins), the order of rows, places in the bytes of the file
/// `database`, times between events, and the design drawn again from the public seed. Columns with equal or no values are left
/// out.
std::vector<Feature> featuresOf(const SeenStudy& study, const std::vector<TextTable>& tables,
                                const std::filesystem::path& database);

}  // namespace study::leaks

// Turns a design over abstract labels into the contents of a study folder. Blinded trial lists hold presentation codes and sealed
// file codes. The station key opens a sealed code: it leads from a presentation to its file, and says nothing else. The
// allocation key holds the fabric and condition of each file.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocols/ids.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol.h"
#include "protocols/secrets/secret_key.h"

namespace protocols {

/// One presentation as the session and the app know it.
struct BlindedTrial {
    TrialNumber number;
    int phase = 0;          ///< index into Protocol::phases
    SealedCode sealedCode;  ///< of its image
    PresentationCode presentationCode;
    std::vector<FabricId> alternatives;  ///< on the tray, in slot order; one fabric in rating phases
    InstructionId instruction = {};      ///< of the phase; empty where it gives none
    SpeedAim aim = SpeedAim::None;       ///< of the instruction
    std::optional<int> deadlineMs = {};  ///< of the instruction
    bool operator==(const BlindedTrial&) const = default;
};

/// File code -> condition and fabric, and the secret that the study was drawn from. Only scripted and simulated participants, the
/// recorded unblinding and aggregates under K-labels may read it.
struct AllocationKey {
    struct Entry {
        FabricId fabric;
        ConditionId condition;
        ConditionLabel label;
        bool operator==(const Entry&) const = default;
    };
    std::map<FileCode, Entry> entries;
    SecretKey secret;

    /// What a presentation shows. Throws workFailed for a code that the secret does not open.
    const Entry& entryOf(const BlindedTrial& trial) const;
};

/// The key that a station needs to show images, derived from the study's secret.
SecretKey stationKeyOf(const SecretKey& secret);

/// Seals a file code for one presentation. Two seals of one code differ.
SealedCode sealed(const FileCode& code, const SecretKey& stationKey);

/// Throws workFailed where the code was sealed with another key or altered.
FileCode opened(const SealedCode& code, const SecretKey& stationKey);

/// The neutral codes on the fabric pieces: three digits, or more in a study with over 900 codes. All codes of a new study differ.
using SwatchLabels = std::map<FabricId, std::string>;

struct Allocation {
    std::vector<std::vector<BlindedTrial>> participants;  ///< [slot][presentation]
    AllocationKey key;                                    ///< with the catch trials, labelled "catch"
    std::vector<SwatchLabels> swatches;                   ///< [slot]
    std::vector<FileCode> familiarisation;                ///< images that no trial shows
};

/// The seed of drawDesign(): the public seed and the secret, so that who knows the public seed cannot draw the design again.
std::uint64_t designSeedOf(const SecretKey& secret, std::uint64_t publicSeed);

/// `fabrics`: those of the study, in the order of the design's numbers. The secret draws the condition of each label, the file
/// codes, the K-labels, the presentation codes and the station key; outside tests it comes from SecretKey::drawn().
/// `familiarisation`: number of images that let the participant get to know the display.
Allocation allocate(const Protocol& protocol, const Design& design, const std::vector<FabricId>& fabrics, const SecretKey& secret,
                    int familiarisation = 0);

/// New file codes, all different, for the images of a study that is sealed after it was made.
std::vector<FileCode> newFileCodes(std::size_t count, const SecretKey& secret);

/// The code of a presentation that is repeated after a void. It has the same form, differs from every code of the list, and is
/// the same in every call. `attempt` counts from 1; the first attempt has the trial's own code.
PresentationCode codeOfAttempt(const std::vector<BlindedTrial>& list, std::size_t index, int attempt);

}  // namespace protocols

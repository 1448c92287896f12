// vis2hap verify STUDY, and vis2hap unblind STUDY --who NAME --why TEXT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "database/evidence/acts.h"
#include "database/keys.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/signing.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/text_checks.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "study/session/clock.h"

namespace study::commands {

namespace {

/// Each head that was given out, and why the log does not contain it. `signedHead`: the statement in the file, whose other lines
/// are no heads, whatever they look like.
nlohmann::ordered_json comparedWith(const database::StudyStore& store, const std::string& against,
                                    const std::optional<records::SignedHead>& signedHead, std::vector<std::string>& faults)
{
    auto rows = nlohmann::ordered_json::array();
    if (against.empty()) return rows;
    records::requireLastingHead(store);
    const auto given = signedHead ? records::GivenHeads{{signedHead->head}, {}} : records::headsIn(against);
    records::HeadCheck check(store);
    for (const auto& head : given.heads) {
        const std::string fault = check.faultOf(head);
        const std::string text = head.sequence == 0 ? head.hash : textOf(head);
        rows.push_back({{"head", text}, {"contained", fault.empty()}});
        if (!fault.empty()) faults.push_back("head " + text + ": " + fault);
    }
    for (const std::string& text : given.unread) {
        rows.push_back({{"head", text}, {"contained", nullptr}, {"why", {{"contained", "this cannot be read as a head"}}}});
        faults.push_back("'" + text +
                         "' looks like a head and cannot be read; expected SEQUENCE:HASH with 16 to 64 of the digits 0 to 9 and "
                         "a to f; compare it with what was given out");
    }
    return rows;
}

struct VerifyCall {
    std::string study, against, publicKey;
    JsonTarget target;
    PassphraseOption passphrase;
};

/// Empty for a study without acts.
std::string headOfActsText(const database::StudyStore& store)
{
    const auto head = headOfActs(store);
    return head.sequence == 0 ? std::string() : protocols::printable(textOf(head));
}

/// The statement of `study sign` in the file of --against; none where that is something else.
std::optional<records::SignedHead> signedHeadOf(const VerifyCall& call)
{
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(call.against, unknown)) return std::nullopt;
    return records::signedHeadIn(protocols::readWholeFile(call.against), call.against);
}

/// Checks the signature of the statement in --against and adds its fault or a note. Null where nothing is signed.
nlohmann::ordered_json checkedSignature(const database::StudyStore& store, const VerifyCall& call,
                                        const std::optional<records::SignedHead>& signedHead, records::Findings& findings)
{
    if (!signedHead && !call.publicKey.empty())
        throw protocols::badInput({"there is no signature to check", call.against.empty() ? "--public-key" : call.against,
                                   "--against FILE with a statement of `vis2hap study sign`", "name that file"});
    if (!signedHead) return nullptr;
    nlohmann::ordered_json row{{"time", signedHead->time}, {"program", signedHead->program}, {"valid", nullptr}};
    if (call.publicKey.empty()) {
        findings.notes.push_back(call.against + ": its signature was not checked: name the public key with --public-key FILE");
        row["why"] = {{"valid", "nobody named the public key"}};
        return row;
    }
    const std::string key = protocols::publicKeyOfPem(protocols::readWholeFile(call.publicKey), call.publicKey);
    const std::string fault = records::faultOfSignature(*signedHead, key, store);
    row["valid"] = fault.empty();
    if (!fault.empty()) findings.faults.push_back(call.against + ": " + fault);
    return row;
}

void print(const std::string& study, const database::StudyStore& store, const records::Findings& findings, std::size_t heads,
           const nlohmann::ordered_json& signature)
{
    const auto& faults = findings.faults;
    for (const auto& fault : faults) std::printf("%s\n", protocols::printable(fault).c_str());
    for (const auto& note : findings.notes) std::printf("note: %s\n", protocols::printable(note).c_str());
    std::printf("%s: %s (%zu answers, %zu stimuli, hash chain, keys, protocol)\n", protocols::printable(study).c_str(),
                faults.empty() ? "sound" : (std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults")).c_str(),
                store.answerCount(), store.stimulusHashes().size());
    if (heads == 1 && faults.empty()) std::puts("  the log contains the given head");
    if (heads > 1 && faults.empty()) std::printf("  the log contains all %zu given heads\n", heads);
    if (signature.is_object() && signature["valid"] == true)
        std::printf("  the signature is that of the public key; the signer's clock said %s, which it does not prove\n",
                    protocols::printable(signature["time"].get<std::string>()).c_str());
    std::printf("  log head %s\n", records::headTextOf(store).c_str());
    if (const auto acts = headOfActsText(store); !acts.empty()) std::printf("  acts head %s\n", acts.c_str());
}

int verify(const VerifyCall& call)
{
    const auto store = records::openStudy(call.study);
    auto findings = records::findingsOf(store, givenPassphrase(call.passphrase));
    const auto signedHead = signedHeadOf(call);
    const auto signature = checkedSignature(store, call, signedHead, findings);
    // A statement of another signer or study says nothing about this log, so that its head would only add a second fault.
    const bool isTrusted = !signature.is_object() || signature["valid"] != false;
    const auto heads = comparedWith(store, isTrusted ? call.against : "", signedHead, findings.faults);
    if (call.target) {
        nlohmann::ordered_json json{{"schema", "vis2hap.verify/1"},
                                    {"study", store.facts().name},
                                    {"sound", findings.faults.empty()},
                                    {"stimuli", store.stimulusHashes().size()},
                                    {"answers", store.answerCount()},
                                    {"head", records::headTextOf(store)},
                                    {"against", heads},
                                    {"signature", signature},
                                    {"faults", findings.faults},
                                    {"notes", findings.notes}};
        if (signature.is_null()) json["why"] = {{"signature", "no signed statement was given (--against)"}};
        if (const auto acts = headOfActsText(store); !acts.empty()) json["acts_head"] = acts;
        writeJson(call.target, json);
    } else
        print(call.study, store, findings, heads.size(), signature);
    return static_cast<int>(findings.faults.empty() ? protocols::ExitCode::Done : protocols::ExitCode::WorkFailed);
}

int unblind(const std::string& study, const std::string& who, const std::string& why, const PassphraseOption& passphrase)
{
    database::StudyStore store({study}, database::StudyStore::Access::Write);
    if (const auto earlier = store.unblinding()) {
        std::printf("%s: already unblinded by %s on %s (%s)\n", protocols::printable(study).c_str(),
                    protocols::printable(earlier->who).c_str(), protocols::printable(earlier->wallTime).c_str(),
                    protocols::printable(earlier->why).c_str());
        if (database::completeUnblinding(store, passphraseFrom(passphrase))) {
            recordAct(store, "unblind");
            std::puts("  its allocation key was missing; it lies open again");
        }
        return 0;
    }
    const auto done = database::unblind(store, {who, why, session::SystemClock().wallTime()}, passphraseFrom(passphrase));
    recordAct(store, "unblind");
    const auto key = readAllocationKey(store, done);
    std::printf("%s: unblinded by %s; this is recorded\n", protocols::printable(study).c_str(),
                protocols::printable(who).c_str());
    std::map<protocols::ConditionLabel, protocols::ConditionId> names;
    for (const auto& [code, entry] : key.entries) names[entry.label] = entry.condition;
    for (const auto& [label, condition] : names)
        std::printf("  %s is %s\n", protocols::printable(label.value).c_str(), protocols::printable(condition.value).c_str());
    return 0;
}

}  // namespace

void addVerify(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("verify", "check the database, hash chain, keys and stimuli of a study");
    auto call = std::make_shared<VerifyCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--against", call->against,
                        "a head of the log or of the acts that was given out earlier (SEQUENCE:HASH), or a file that contains "
                        "some: finds a log that was cut, put back or written anew");
    command->add_option("--passphrase-file", call->passphrase.file,
                        "file with the owner's passphrase in its first line: opens the sealed key, too (default: "
                        "VIS2HAP_PASSPHRASE)");
    command->add_option("--public-key", call->publicKey,
                        "public key of the laboratory: checks the signature of --against FILE (a statement of `study sign`)");
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return verify(*call); };
    });
}

void addUnblind(CLI::App& app, Action& action)
{
    struct UnblindCall {
        std::string study, who, why;
        PassphraseOption passphrase;
    };
    auto* command = app.add_subcommand("unblind", "reveal the conditions of a study; who and why are recorded");
    auto call = std::make_shared<UnblindCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--who", call->who, "your name")->required()->check(isName());
    command->add_option("--why", call->why, "the reason")->required()->check(isReason());
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return unblind(call->study, call->who, call->why, call->passphrase); };
    });
}

}  // namespace study::commands

// vis2hap study data-sheet|signing-key|sign
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/signing.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/passphrase_option.h"
#include "study/commands/recorded_act.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/data_sheet_text.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"

namespace study::commands {

namespace {

struct SheetCall {
    std::string study, out;
    JsonTarget target;
};

int writeDataSheet(const SheetCall& call)
{
    const auto sheet = records::dataSheetOf(records::openStudy(call.study));
    if (call.target) writeJson(call.target, sheet);
    if (!call.out.empty()) {
        protocols::writeWholeFile(call.out, records::textOfDataSheet(sheet));
        if (!call.target)
            std::printf("%s: data sheet of %s\n", protocols::printable(call.out).c_str(),
                        protocols::printable(call.study).c_str());
    } else if (!call.target) {
        std::fputs(protocols::printableLines(records::textOfDataSheet(sheet)).c_str(), stdout);
    }
    return 0;
}

struct KeyCall {
    std::string out;
    bool hasNoPassphrase = false;
    PassphraseOption passphrase;
};

int makeSigningKey(const KeyCall& call)
{
    const std::string openFile = call.out + ".pub";
    protocols::requireNewFile(call.out);
    protocols::requireNewFile(openFile);
    const auto seed = protocols::SecretKey::drawn();
    const std::string text = records::signingKeyText(
        seed, call.hasNoPassphrase ? std::nullopt : std::optional(newPassphrase(call.passphrase, "the signing key")));
    protocols::writeWholeFile(call.out, text, protocols::Sync::Now, protocols::Readers::OwnerOnly);
    protocols::writeWholeFile(openFile, protocols::pemOf(protocols::publicKeyOf(seed)));
    std::printf("%s: the signing key; keep it secret, and away from the studies\n", protocols::printable(call.out).c_str());
    std::printf("%s: the public key; give it to everybody who checks\n", protocols::printable(openFile).c_str());
    noteIfReadByAll(call.out);
    return 0;
}

struct SignCall {
    std::string study, key, out;
    PassphraseOption passphrase;
};

int sign(const SignCall& call)
{
    const auto store = records::openStudy(call.study);
    const auto seed = records::signingKeyOf(protocols::readWholeFile(call.key), call.key,
                                            passphraseFrom(call.passphrase, "passphrase of the signing key"));
    const auto faults = records::findingsOf(store).faults;
    if (!faults.empty())
        throw protocols::workFailed({"the study is not sound: " + faults.front(), call.study, "a study without faults",
                                     "see `vis2hap verify " + protocols::shellWord(call.study) + "`; nothing was signed"});
    const std::string text = records::signedHeadText(store, seed, versionText());
    protocols::writeWholeFile(call.out, text);
    std::fputs(protocols::printableLines(text).c_str(), stdout);
    std::printf("%s: signed; this proves who vouches for the head, not when\n", protocols::printable(call.out).c_str());
    recordAct(store, "sign", call.out);
    return 0;
}

void addDataSheet(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("data-sheet", "what is stored, where, how long, and who reads it; for an ethics board");
    auto call = std::make_shared<SheetCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--out", call->out, "text file to write (default: standard output)");
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return writeDataSheet(*call); };
    });
}

void addSigningKey(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("signing-key", "make a key of the laboratory that signs heads of logs (Ed25519)");
    auto call = std::make_shared<KeyCall>();
    command->add_option("--out", call->out, "file of the key; FILE.pub becomes the public key")->required();
    addPassphraseOption(*command, call->passphrase);
    command->add_flag("--no-passphrase", call->hasNoPassphrase, "leave the key open in the file");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return makeSigningKey(*call); };
    });
}

void addSign(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("sign", "sign the head of the log; `verify --against FILE --public-key KEY` checks it");
    auto call = std::make_shared<SignCall>();
    command->add_option("STUDY", call->study, "the study")->required();
    command->add_option("--key", call->key, "the key of `study signing-key`")->required();
    command->add_option("--out", call->out, "file to write the signed statement to")->required();
    addPassphraseOption(*command, call->passphrase);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [call] { return sign(*call); };
    });
}

}  // namespace

void addProof(CLI::App& study, Action& action)
{
    addDataSheet(study, action);
    addSigningKey(study, action);
    addSign(study, action);
}

}  // namespace study::commands

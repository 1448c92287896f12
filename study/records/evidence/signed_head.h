// A head of the log, signed with a key of the laboratory. A signature proves who vouched for the head. It does not prove when:
// the time in the statement is what the signer's computer said.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "database/study_store.h"
#include "protocols/secrets/secret_key.h"

namespace study::records {

struct SignedHead {
    std::string study;          ///< its name
    std::string studyId;        ///< hash of the log's first entry, which no other study has
    database::LogHead head;     ///< its number is the number of entries
    std::string time, program;  ///< of the signing
    std::string publicKey;      ///< hexadecimal
    std::string statement;      ///< the signed bytes: every line before that of the signature
    std::string signature;      ///< hexadecimal
};

/// The whole file: lines "name: value", the last of which is the signature. Anyone can check it with the public key.
std::string signedHeadText(const database::StudyStore& store, const protocols::SecretKey& seed, const std::string& program);

/// The statement in a file; empty where the text is something else. Throws badInput for a statement with missing or changed
/// lines.
std::optional<SignedHead> signedHeadIn(const std::string& text, const std::string& where);

/// Why the file does not prove that the key's owner vouched for this study's head: another key, altered, another study. Empty
/// where it does. Whether the log still has the head is faultAgainst() (log_heads.h).
std::string faultOfSignature(const SignedHead& head, const std::string& publicKey, const database::StudyStore& store);

/// The text of a file for a new signing key. `passphrase`: seals it; empty: the key lies open.
std::string signingKeyText(const protocols::SecretKey& seed, const std::optional<std::string>& passphrase);

/// The key in such a text. `passphrase` is asked only for a sealed one. Throws badInput without the right passphrase, and for
/// another text.
protocols::SecretKey signingKeyOf(const std::string& text, const std::string& where,
                                  const std::function<std::optional<std::string>()>& passphrase);

}  // namespace study::records

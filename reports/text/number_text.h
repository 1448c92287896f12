// Numbers as people and files read them, independent of the locale.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "stats/kernels/value.h"

namespace reports {

using Json = nlohmann::ordered_json;

/// Shortest text that reads back as the same double.
std::string shortest(double number);

/// With this many digits after the point; a negative zero loses its sign.
std::string fixed(double number, int decimals);

/// A probability as papers print it: ".032", "< .001", "1.00".
std::string pText(double p);

/// "1 presentation", "3 presentations".
std::string counted(std::size_t n, const std::string& singular);

std::string escapedHtml(const std::string& text);
std::string escapedTex(const std::string& text);

/// object[key] = reason in object["why"], the value being null.
void putNull(Json& object, const std::string& key, const std::string& why);

/// Moves "why", where there is one, behind all other keys.
void putReasonsLast(Json& object);

/// The number, or null with its reason. A number that is not finite is null too.
void put(Json& object, const std::string& key, const stats::Value& value);

/// A number that is whole in spirit (degrees of freedom): written without ".0" where it is.
void putWhole(Json& object, const std::string& key, const stats::Value& value);

/// A p value: one too small for a double is null with its power of ten.
void putP(Json& object, const std::string& key, const stats::Value& p, const stats::Value& logP);

/// [low, high], or null with the reason.
void put(Json& object, const std::string& key, const stats::Interval& interval);

/// A field of an object as a number again; its reason where it is null or missing.
stats::Value valueOf(const Json& object, const std::string& key);
stats::Interval intervalOf(const Json& object, const std::string& key);

}  // namespace reports

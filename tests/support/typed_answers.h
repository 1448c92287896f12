// What was typed into the window and what the study stored of it, in one form to compare.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "tests/support/open_window.h"

namespace tests::support {

/// "P01 7 Q3" -> "F02", "5.4", "same" or words.
using Answers = std::map<std::string, std::string>;

std::string answerText(const study::session::GivenAnswer& response);
std::vector<database::CurrentAnswer> storedIn(const database::StudyFolder& folder);
Answers answersIn(const database::StudyFolder& folder);

/// The name of the answer that is now asked for, as in Answers.
std::string nowAsked(OpenWindow& open);

/// Keys to whatever has the focus.
void pressKey(OpenWindow& open, Qt::Key key);
void typeText(OpenWindow& open, const QString& text);

/// The letter, the number (with this decimal point) or the words.
void enterByKeys(OpenWindow& open, const study::session::GivenAnswer& response, QChar point = u'.');

/// One answer by keys alone: the first touch, two seconds, the entry, Enter.
void answerByKeys(OpenWindow& open, const study::session::GivenAnswer& response, QChar point = u'.');

}  // namespace tests::support

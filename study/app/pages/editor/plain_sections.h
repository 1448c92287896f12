// The sections of the editor whose fields stand for themselves: course of a session, texts.
#pragma once

class QWidget;

namespace study::app {

class DraftFields;

/// Breaks, sittings, pieces on the tray and entries. `parent` owns it.
QWidget* courseSection(DraftFields& fields, QWidget* parent);

/// What is said, read, ticked, measured and asked, and what the participant sees and hears. `parent` owns it.
QWidget* textsSection(DraftFields& fields, QWidget* parent);

}  // namespace study::app

<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de">
<context>
    <name>study::app::AnalysisSection</name>
    <message>
        <source>Lower bound of equivalence</source>
        <translation>Untere Grenze der Äquivalenz</translation>
    </message>
    <message>
        <source>Upper bound of equivalence</source>
        <translation>Obere Grenze der Äquivalenz</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Make it the primary one</source>
        <translation>Zum Hauptkontrast machen</translation>
    </message>
    <message>
        <source>First condition of the contrast</source>
        <translation>Erste Bedingung des Kontrasts</translation>
    </message>
    <message>
        <source>Second condition of the contrast</source>
        <translation>Zweite Bedingung des Kontrasts</translation>
    </message>
    <message>
        <source>Add the contrast</source>
        <translation>Kontrast hinzufügen</translation>
    </message>
    <message>
        <source>Analysis</source>
        <translation>Auswertung</translation>
    </message>
    <message>
        <source>Decide before the first participant comes what the report tests first, and which difference is too small to matter.</source>
        <translation>Entscheiden Sie, bevor die erste Versuchsperson kommt, was der Bericht zuerst prüft und welcher Unterschied zu klein ist, um etwas zu bedeuten.</translation>
    </message>
    <message>
        <source>Equal from (scale points)</source>
        <translation>Gleich von (Skalenpunkte)</translation>
    </message>
    <message>
        <source>to (scale points)</source>
        <translation>bis (Skalenpunkte)</translation>
    </message>
    <message>
        <source>Bounds of equivalence</source>
        <translation>Grenzen der Äquivalenz</translation>
    </message>
    <message>
        <source>Planned contrasts</source>
        <translation>Geplante Kontraste</translation>
    </message>
    <message>
        <source>Pairs of conditions. The primary one is tested first; without a choice it is the first.</source>
        <translation>Paare von Bedingungen. Der Hauptkontrast wird zuerst geprüft; ohne Wahl ist es der erste.</translation>
    </message>
    <message>
        <source>Primary contrast</source>
        <translation>Hauptkontrast</translation>
    </message>
    <message>
        <source>%1 − %2</source>
        <translation>%1 − %2</translation>
    </message>
    <message>
        <source>%1    (primary)</source>
        <translation>%1    (Hauptkontrast)</translation>
    </message>
    <message>
        <source>Both conditions are the same. Choose two different ones.</source>
        <translation>Beide Bedingungen sind dieselbe. Wählen Sie zwei verschiedene.</translation>
    </message>
    <message>
        <source>This pair is planned already. Choose another one.</source>
        <translation>Dieses Paar ist schon geplant. Wählen Sie ein anderes.</translation>
    </message>
</context>
<context>
    <name>study::app::AppText</name>
    <message>
        <source>.</source>
        <comment>decimal mark</comment>
        <translation>,</translation>
    </message>
    <message>
        <source>The disk of %1 cannot be asked for its room.</source>
        <translation>Der freie Platz auf dem Datenträger von %1 lässt sich nicht abfragen.</translation>
    </message>
    <message>
        <source>The disk has %1 MB of room left. Make room for at least 100 MB.</source>
        <translation>Auf dem Datenträger sind noch %1 MB frei. Schaffen Sie mindestens 100 MB Platz.</translation>
    </message>
    <message>
        <source>Nothing can be written into the study&apos;s folder. See whether the disk is full or locked.</source>
        <translation>In den Ordner der Studie lässt sich nichts schreiben. Prüfen Sie, ob der Datenträger voll oder gesperrt ist.</translation>
    </message>
    <message>
        <source>A write took %1 ms, so an answer would wait. End other work on this disk, or use a faster one.</source>
        <translation>Ein Schreibvorgang dauerte %1 ms; eine Antwort müsste so lange warten. Beenden Sie andere Arbeit auf diesem Datenträger oder nehmen Sie einen schnelleren.</translation>
    </message>
    <message>
        <source>The computer&apos;s clock is behind the last entry of the study. Set the clock.</source>
        <translation>Die Uhr des Rechners geht dem letzten Eintrag der Studie nach. Stellen Sie die Uhr.</translation>
    </message>
    <message>
        <source>This computer has no clock that runs evenly, so response times cannot be measured.</source>
        <translation>Dieser Rechner hat keine gleichmäßig laufende Uhr; Antwortzeiten lassen sich nicht messen.</translation>
    </message>
    <message>
        <source>Welcome the participant</source>
        <translation>Begrüßen Sie die Versuchsperson</translation>
    </message>
    <message>
        <source>The participant does not wear the mask yet.</source>
        <translation>Die Versuchsperson trägt noch keine Augenmaske.</translation>
    </message>
    <message>
        <source>Give the participant the information sheet and time to read it.</source>
        <translation>Geben Sie der Versuchsperson das Informationsblatt und Zeit, es zu lesen.</translation>
    </message>
    <message>
        <source>Explain the session: the participant strokes the glass and pieces of fabric and says how they feel. There are breaks.</source>
        <translation>Erklären Sie den Versuch: Die Versuchsperson streicht über das Glas und über Stoffproben und sagt, wie sie sich anfühlen. Es gibt Pausen.</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Begin (Enter)</source>
        <translation>Beginnen (Enter)</translation>
    </message>
    <message>
        <source>Consent</source>
        <translation>Einwilligung</translation>
    </message>
    <message>
        <source>You confirm: %1.</source>
        <translation>Sie bestätigen: %1.</translation>
    </message>
    <message>
        <source>If the participant does not agree, do not begin. Press W instead.</source>
        <translation>Wenn die Versuchsperson nicht einwilligt, beginnen Sie nicht. Drücken Sie stattdessen W.</translation>
    </message>
    <message>
        <source>The participant has agreed (Enter)</source>
        <translation>Die Versuchsperson hat eingewilligt (Enter)</translation>
    </message>
    <message>
        <source>The participant may lift the mask, drink and move the hand.</source>
        <translation>Die Versuchsperson darf die Augenmaske abnehmen, trinken und die Hand bewegen.</translation>
    </message>
    <message>
        <source>Clean the glass and the participant&apos;s finger. Let both dry.</source>
        <translation>Reinigen Sie das Glas und den Finger der Versuchsperson. Lassen Sie beides trocknen.</translation>
    </message>
    <message>
        <source>Make sure that the participant wears the mask again before you continue.</source>
        <translation>Achten Sie darauf, dass die Versuchsperson die Augenmaske wieder trägt, bevor Sie fortfahren.</translation>
    </message>
    <message>
        <source>Break</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Break: new questions follow</source>
        <translation>Pause: Es folgen neue Fragen</translation>
    </message>
    <message>
        <source>Break: time for a rest</source>
        <translation>Pause: Zeit zum Ausruhen</translation>
    </message>
    <message>
        <source>This sitting has lasted %1 minutes</source>
        <translation>Diese Sitzung dauert schon %1 Minuten</translation>
    </message>
    <message>
        <source>The head of the log cannot be read now.</source>
        <translation>Der Logbuch-Stand lässt sich gerade nicht lesen.</translation>
    </message>
    <message>
        <source>Write down the head of the log: %1</source>
        <translation>Schreiben Sie den Logbuch-Stand auf: %1</translation>
    </message>
    <message>
        <source>%1 of %2 answers are stored. The display is off.</source>
        <translation>%1 von %2 Antworten sind gespeichert. Das Display ist aus.</translation>
    </message>
    <message>
        <source>Questions that follow: %1. Explain them before the participant puts the mask on.</source>
        <translation>Es folgen diese Fragen: %1. Erklären Sie sie, bevor die Versuchsperson die Augenmaske aufsetzt.</translation>
    </message>
    <message>
        <source>A tired hand feels less. Press Q to stop here and continue on another day. Everything is stored.</source>
        <translation>Eine müde Hand spürt weniger. Drücken Sie Q, um hier aufzuhören und an einem anderen Tag weiterzumachen. Alles ist gespeichert.</translation>
    </message>
    <message>
        <source>Continue (Enter)</source>
        <translation>Fortfahren (Enter)</translation>
    </message>
    <message>
        <source>Continue anyway (Enter)</source>
        <translation>Trotzdem fortfahren (Enter)</translation>
    </message>
    <message>
        <source>Stop here for today (Q)</source>
        <translation>Für heute aufhören (Q)</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>All answers so far are stored. The display is off.</source>
        <translation>Alle bisherigen Antworten sind gespeichert. Das Display ist aus.</translation>
    </message>
    <message>
        <source>An interrupted presentation starts again with the tray.</source>
        <translation>Eine unterbrochene Darbietung beginnt wieder mit dem Tablett.</translation>
    </message>
    <message>
        <source>You may close the window now. The session continues here later.</source>
        <translation>Sie können das Fenster jetzt schließen. Der Versuch geht später hier weiter.</translation>
    </message>
    <message>
        <source>Continue the session (Enter)</source>
        <translation>Versuch fortsetzen (Enter)</translation>
    </message>
    <message>
        <source>Welcome back</source>
        <translation>Willkommen zurück</translation>
    </message>
    <message>
        <source>A new sitting begins. %1 of %2 answers are stored. %3</source>
        <translation>Eine neue Sitzung beginnt. %1 von %2 Antworten sind gespeichert. %3</translation>
    </message>
    <message>
        <source>First repeat the scale and the checklist.</source>
        <translation>Wiederholen Sie zuerst die Skala und die Checkliste.</translation>
    </message>
    <message>
        <source>First repeat the scale.</source>
        <translation>Wiederholen Sie zuerst die Skala.</translation>
    </message>
    <message>
        <source>First repeat the checklist.</source>
        <translation>Wiederholen Sie zuerst die Checkliste.</translation>
    </message>
    <message>
        <source>After a short interruption you may skip this if everything is still in place.</source>
        <translation>Nach einer kurzen Unterbrechung können Sie das überspringen, wenn noch alles an seinem Platz ist.</translation>
    </message>
    <message>
        <source>Prepare this sitting (Enter)</source>
        <translation>Sitzung vorbereiten (Enter)</translation>
    </message>
    <message>
        <source>Skip the preparation (G)</source>
        <translation>Vorbereitung überspringen (G)</translation>
    </message>
    <message>
        <source>The session is complete</source>
        <translation>Der Versuch ist abgeschlossen</translation>
    </message>
    <message>
        <source>All %1 answers are stored. Thank the participant for the time and care.</source>
        <translation>Alle %1 Antworten sind gespeichert. Danken Sie der Versuchsperson für Zeit und Sorgfalt.</translation>
    </message>
    <message>
        <source>Clean the glass and put the fabrics back in order.</source>
        <translation>Reinigen Sie das Glas und räumen Sie die Stoffe wieder ein.</translation>
    </message>
    <message>
        <source>Back to the study (Enter)</source>
        <translation>Zurück zur Studie (Enter)</translation>
    </message>
    <message>
        <source>The participant has withdrawn</source>
        <translation>Die Versuchsperson ist zurückgetreten</translation>
    </message>
    <message>
        <source>The session has ended. Stored answers: %1. The study&apos;s owner gives this place out again.</source>
        <translation>Der Versuch ist beendet. Gespeicherte Antworten: %1. Die Leitung der Studie vergibt diesen Platz wieder.</translation>
    </message>
    <message>
        <source>The session has ended. Stored answers: %1. Another participant can take this place.</source>
        <translation>Der Versuch ist beendet. Gespeicherte Antworten: %1. Eine andere Versuchsperson kann diesen Platz einnehmen.</translation>
    </message>
    <message>
        <source>Thank the participant for coming.</source>
        <translation>Danken Sie der Versuchsperson für ihr Kommen.</translation>
    </message>
    <message>
        <source>“%1.” (%2)</source>
        <translation>„%1.“ (%2)</translation>
    </message>
    <message>
        <source>Same</source>
        <translation>Gleich</translation>
    </message>
    <message>
        <source>Different</source>
        <translation>Verschieden</translation>
    </message>
    <message>
        <source>“%1.”</source>
        <translation>„%1.“</translation>
    </message>
    <message>
        <source>Piece %1</source>
        <translation>Probe %1</translation>
    </message>
    <message>
        <source>The two entries differ: “%1” and “%2”. Ask the participant again, then enter the answer twice.</source>
        <translation>Die beiden Eingaben sind verschieden: „%1“ und „%2“. Fragen Sie die Versuchsperson noch einmal und geben Sie die Antwort dann zweimal ein.</translation>
    </message>
    <message>
        <source>Confirm the tray, store the answer, go on</source>
        <translation>Tablett bestätigen, Antwort speichern, weiter</translation>
    </message>
    <message>
        <source>Stamp the first touch</source>
        <translation>Erste Berührung stempeln</translation>
    </message>
    <message>
        <source>The answer begins (the spoken word)</source>
        <translation>Die Antwort beginnt (das gesprochene Wort)</translation>
    </message>
    <message>
        <source>Correct a stored answer</source>
        <translation>Gespeicherte Antwort berichtigen</translation>
    </message>
    <message>
        <source>Write a note</source>
        <translation>Notiz schreiben</translation>
    </message>
    <message>
        <source>Flag the presentation</source>
        <translation>Darbietung markieren</translation>
    </message>
    <message>
        <source>Void the presentation</source>
        <translation>Darbietung für ungültig erklären</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Stop for now</source>
        <translation>Für jetzt aufhören</translation>
    </message>
    <message>
        <source>Withdrawal of the participant</source>
        <translation>Rücktritt der Versuchsperson</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Enter</translation>
    </message>
    <message>
        <source>Page Down</source>
        <translation>Bild ab</translation>
    </message>
    <message>
        <source>Page Up</source>
        <translation>Bild auf</translation>
    </message>
    <message>
        <source>%1 is the standard key of “%2”. Press another key.</source>
        <translation>%1 ist die Standardtaste für „%2“. Drücken Sie eine andere Taste.</translation>
    </message>
    <message>
        <source>%1 acts as “%2” already. Press another key, or remove it there first.</source>
        <translation>%1 steht schon für „%2“. Drücken Sie eine andere Taste oder entfernen Sie diese dort zuerst.</translation>
    </message>
    <message>
        <source>This key moves or edits in a field. Press another key, such as F13 or Page Down.</source>
        <translation>Diese Taste bewegt oder bearbeitet in einem Feld. Drücken Sie eine andere Taste, zum Beispiel F13 oder Bild ab.</translation>
    </message>
    <message>
        <source>This key writes a character, and characters are answers. Set the pedal to another key, such as F13.</source>
        <translation>Diese Taste schreibt ein Zeichen, und Zeichen sind Antworten. Stellen Sie das Pedal auf eine andere Taste ein, zum Beispiel F13.</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1 oder %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>welcome</source>
        <translation>Begrüßung</translation>
    </message>
    <message>
        <source>consent</source>
        <translation>Einwilligung</translation>
    </message>
    <message>
        <source>facts</source>
        <translation>Angaben</translation>
    </message>
    <message>
        <source>familiarisation</source>
        <translation>Eingewöhnung</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>Skala</translation>
    </message>
    <message>
        <source>checklist</source>
        <translation>Checkliste</translation>
    </message>
    <message>
        <source>tray</source>
        <translation>Tablett</translation>
    </message>
    <message>
        <source>question %1</source>
        <translation>Frage %1</translation>
    </message>
    <message>
        <source>break</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>debriefing</source>
        <translation>Nachgespräch</translation>
    </message>
    <message>
        <source>finished</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>withdrawn</source>
        <translation>zurückgetreten</translation>
    </message>
    <message>
        <source>withdrawn, waits for the owner</source>
        <translation>zurückgetreten, wartet auf die Leitung</translation>
    </message>
    <message>
        <source>paused (%1)</source>
        <translation>angehalten (%1)</translation>
    </message>
    <message>
        <source>erased</source>
        <translation>gelöscht</translation>
    </message>
    <message>
        <source>Type the number that the participant says.</source>
        <translation>Tippen Sie die Zahl, die die Versuchsperson sagt.</translation>
    </message>
    <message>
        <source>“%1” is not a rating. Type a number with at most one decimal, such as 5.4.</source>
        <translation>„%1“ ist keine Bewertung. Tippen Sie eine Zahl mit höchstens einer Nachkommastelle, zum Beispiel 5,4.</translation>
    </message>
    <message>
        <source>%1 is outside the scale. Ratings go from %2 to %3. Ask the participant again.</source>
        <translation>%1 liegt außerhalb der Skala. Bewertungen gehen von %2 bis %3. Fragen Sie die Versuchsperson noch einmal.</translation>
    </message>
    <message>
        <source>%1 is between two steps of the scale. Ratings go in steps of %2. Ask the participant again.</source>
        <translation>%1 liegt zwischen zwei Stufen der Skala. Bewertungen gehen in Schritten von %2. Fragen Sie die Versuchsperson noch einmal.</translation>
    </message>
    <message>
        <source>from %1 to %2, one decimal</source>
        <translation>von %1 bis %2, eine Nachkommastelle</translation>
    </message>
    <message>
        <source>from %1 to %2, whole numbers</source>
        <translation>von %1 bis %2, ganze Zahlen</translation>
    </message>
    <message>
        <source>from %1 to %2 in steps of %3</source>
        <translation>von %1 bis %2 in Schritten von %3</translation>
    </message>
    <message>
        <source>take off %1</source>
        <translation>%1 wegnehmen</translation>
    </message>
    <message>
        <source>put %1 on the tray</source>
        <translation>%1 auf das Tablett legen</translation>
    </message>
    <message>
        <source>put %1 on %2</source>
        <translation>%1 auf %2 legen</translation>
    </message>
    <message>
        <source>move %1 from %2 to %3</source>
        <translation>%1 von %2 nach %3 legen</translation>
    </message>
    <message>
        <source>All pieces stay on the tray.</source>
        <translation>Alle Proben bleiben auf dem Tablett.</translation>
    </message>
    <message>
        <source>en</source>
        <comment>language of new protocols</comment>
        <extracomment>The BCP 47 tag of your language, such as &quot;de&quot;: new protocols take their texts for participants from it.</extracomment>
        <translation>de</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between the names of a list</comment>
        <translation>, </translation>
    </message>
    <message>
        <source>%1 %2</source>
        <comment>two sentences</comment>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>; </source>
        <comment>between the parts of a message</comment>
        <translation>; </translation>
    </message>
    <message>
        <source>This computer has no font for the language of the participants, %1: they would see boxes. Run: apt-get install %2</source>
        <translation>Dieser Rechner hat keine Schrift für die Sprache der Versuchspersonen, %1: Sie sähen nur Kästchen. Rufen Sie auf: apt-get install %2</translation>
    </message>
    <message>
        <source>free</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>%1 is no longer in the study&apos;s folder, so no answer can be stored. Close the study, then run vis2hap rescue on its folder: closing keeps every stored answer in a rescue file.</source>
        <translation>%1 liegt nicht mehr im Ordner der Studie; deshalb kann keine Antwort gespeichert werden. Schließen Sie die Studie, und rufen Sie dann vis2hap rescue mit ihrem Ordner auf: Beim Schließen kommt jede gespeicherte Antwort in eine Rettungsdatei.</translation>
    </message>
</context>
<context>
    <name>study::app::Below</name>
    <message>
        <source>The time stamp of the event is outside every session.</source>
        <translation>Der Zeitstempel des Ereignisses liegt außerhalb jeder Sitzung.</translation>
    </message>
    <message>
        <source>The participant has named enough places.</source>
        <translation>Die Versuchsperson hat genug Stellen benannt.</translation>
    </message>
    <message>
        <source>There is no such fabric for getting to know the display.</source>
        <translation>Einen solchen Stoff zum Kennenlernen des Displays gibt es nicht.</translation>
    </message>
    <message>
        <source>This is not the place on the line that is shown.</source>
        <translation>Das ist nicht die Stelle auf der Linie, die gezeigt wird.</translation>
    </message>
    <message>
        <source>The time of the first touch is stored already.</source>
        <translation>Die Zeit der ersten Berührung ist schon gespeichert.</translation>
    </message>
    <message>
        <source>This sitting is prepared already.</source>
        <translation>Diese Sitzung ist schon vorbereitet.</translation>
    </message>
    <message>
        <source>There has been no presentation yet.</source>
        <translation>Es gab noch keine Darbietung.</translation>
    </message>
    <message>
        <source>The presentation before this one is void already.</source>
        <translation>Die Darbietung davor ist schon ungültig.</translation>
    </message>
    <message>
        <source>The session is over. There is nothing to pause.</source>
        <translation>Der Versuch ist zu Ende. Es gibt nichts anzuhalten.</translation>
    </message>
    <message>
        <source>The session is not paused.</source>
        <translation>Der Versuch ist nicht angehalten.</translation>
    </message>
    <message>
        <source>The participant has withdrawn already.</source>
        <translation>Die Versuchsperson ist schon zurückgetreten.</translation>
    </message>
    <message>
        <source>The participant has withdrawn. Answers cannot be changed.</source>
        <translation>Die Versuchsperson ist zurückgetreten. Antworten lassen sich nicht mehr ändern.</translation>
    </message>
    <message>
        <source>The session is finished. Answers can be corrected until the debriefing is stored.</source>
        <translation>Der Versuch ist abgeschlossen. Antworten lassen sich korrigieren, bis das Nachgespräch gespeichert ist.</translation>
    </message>
    <message>
        <source>There is no answer to %1 yet.</source>
        <translation>Auf %1 gibt es noch keine Antwort.</translation>
    </message>
    <message>
        <source>The note is empty.</source>
        <translation>Die Notiz ist leer.</translation>
    </message>
    <message>
        <source>There is no presentation to flag yet.</source>
        <translation>Es gibt noch keine Darbietung zum Markieren.</translation>
    </message>
    <message>
        <source>The session is paused. Resume it first.</source>
        <translation>Der Versuch ist angehalten. Setzen Sie ihn zuerst fort.</translation>
    </message>
    <message>
        <source>The participant&apos;s list is empty.</source>
        <translation>Die Liste der Versuchsperson ist leer.</translation>
    </message>
    <message>
        <source>The text holds a character that nobody sees and that is not stored as it is. Type the text again.</source>
        <translation>Der Text enthält ein Zeichen, das niemand sieht und das nicht unverändert gespeichert wird. Geben Sie den Text noch einmal ein.</translation>
    </message>
    <message>
        <source>The text is longer than 100,000 bytes, so it is not stored. Shorten it.</source>
        <translation>Der Text ist länger als 100.000 Bytes und wird deshalb nicht gespeichert. Kürzen Sie ihn.</translation>
    </message>
    <message>
        <source>The entry is too long, so it is not stored. Shorten its texts.</source>
        <translation>Der Eintrag ist zu lang und wird deshalb nicht gespeichert. Kürzen Sie seine Texte.</translation>
    </message>
    <message>
        <source>The last step was only just taken, so this key confirmed nothing. Put the pieces on the tray, then confirm it.</source>
        <translation>Der letzte Schritt ist eben erst geschehen; diese Taste hat nichts bestätigt. Legen Sie die Proben auf das Tablett und bestätigen Sie es dann.</translation>
    </message>
    <message>
        <source>The last step was only just taken, so this key confirmed nothing. Press it again.</source>
        <translation>Der letzte Schritt ist eben erst geschehen; diese Taste hat nichts bestätigt. Drücken Sie sie noch einmal.</translation>
    </message>
    <message>
        <source>The piece in slot %1 is not confirmed. It must be %2.</source>
        <translation>Die Probe in Feld %1 ist nicht bestätigt. Es muss %2 sein.</translation>
    </message>
    <message>
        <source>Slot %1 holds %2. It must be %3.</source>
        <translation>In Feld %1 liegt %2. Es muss %3 sein.</translation>
    </message>
    <message>
        <source>More pieces were confirmed than the tray has slots.</source>
        <translation>Es wurden mehr Proben bestätigt, als das Tablett Felder hat.</translation>
    </message>
    <message>
        <source>The session is finished.</source>
        <translation>Der Versuch ist abgeschlossen.</translation>
    </message>
    <message>
        <source>The participant has withdrawn.</source>
        <translation>Die Versuchsperson ist zurückgetreten.</translation>
    </message>
    <message>
        <source>No question is being asked now.</source>
        <translation>Jetzt wird keine Frage gestellt.</translation>
    </message>
    <message>
        <source>There is no presentation to void yet.</source>
        <translation>Es gibt noch keine Darbietung, die ungültig werden könnte.</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not possible now (%2).</source>
        <translation>„%1“ ist jetzt nicht möglich (%2).</translation>
    </message>
    <message>
        <source>%1 is not on the tray (%2).</source>
        <translation>%1 liegt nicht auf dem Tablett (%2).</translation>
    </message>
    <message>
        <source>%1 is not on the scale: from %2 to %3 in steps of %4.</source>
        <translation>%1 liegt nicht auf der Skala: von %2 bis %3 in Schritten von %4.</translation>
    </message>
    <message>
        <source>%1 asks for %2, not for %3.</source>
        <translation>%1 fragt nach %2, nicht nach %3.</translation>
    </message>
    <message>
        <source>one of the fabrics on the tray</source>
        <translation>einem der Stoffe auf dem Tablett</translation>
    </message>
    <message>
        <source>a number on the scale</source>
        <translation>einer Zahl auf der Skala</translation>
    </message>
    <message>
        <source>same or different</source>
        <translation>gleich oder verschieden</translation>
    </message>
    <message>
        <source>words</source>
        <translation>Worten</translation>
    </message>
    <message>
        <source>same</source>
        <translation>gleich</translation>
    </message>
    <message>
        <source>different</source>
        <translation>verschieden</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keines</translation>
    </message>
    <message>
        <source>uniform</source>
        <translation>gleichmäßig</translation>
    </message>
    <message>
        <source>edge</source>
        <translation>Kante</translation>
    </message>
    <message>
        <source>grating %1 mm</source>
        <translation>Gitter %1 mm</translation>
    </message>
    <message>
        <source>left–right ramp</source>
        <translation>Verlauf von links nach rechts</translation>
    </message>
    <message>
        <source>the image cannot be written into the display&apos;s folder (%1)</source>
        <translation>das Bild lässt sich nicht in den Ordner des Displays schreiben (%1)</translation>
    </message>
    <message>
        <source>a writable folder</source>
        <translation>ein beschreibbarer Ordner</translation>
    </message>
    <message>
        <source>free space or correct the permissions, then show the image again</source>
        <translation>schaffen Sie Platz oder berichtigen Sie die Rechte und zeigen Sie das Bild dann noch einmal</translation>
    </message>
    <message>
        <source>unknown display &apos;%1&apos;</source>
        <translation>unbekanntes Display „%1“</translation>
    </message>
    <message>
        <source>correct the name of the display</source>
        <translation>berichtigen Sie den Namen des Displays</translation>
    </message>
    <message>
        <source>there is no output for sound</source>
        <translation>es gibt keine Tonausgabe</translation>
    </message>
    <message>
        <source>headphones or loudspeakers, 48 kHz stereo</source>
        <translation>Kopfhörer oder Lautsprecher, 48 kHz Stereo</translation>
    </message>
    <message>
        <source>connect the headphones, then start the sound again</source>
        <translation>schließen Sie die Kopfhörer an und starten Sie dann den Ton erneut</translation>
    </message>
    <message>
        <source>the output for sound cannot be opened</source>
        <translation>die Tonausgabe lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>a free output</source>
        <translation>eine freie Ausgabe</translation>
    </message>
    <message>
        <source>close other programs that play sound, then start it again</source>
        <translation>schließen Sie andere Programme, die Ton abspielen, und starten Sie ihn dann erneut</translation>
    </message>
    <message>
        <source>the output for sound has stopped</source>
        <translation>die Tonausgabe ist ausgefallen</translation>
    </message>
    <message>
        <source>the output for sound is no longer connected</source>
        <translation>die Tonausgabe ist nicht mehr verbunden</translation>
    </message>
    <message>
        <source>covering the only screen would hide the console</source>
        <translation>eine Abdeckung des einzigen Bildschirms würde dieses Fenster verdecken</translation>
    </message>
    <message>
        <source>there is no screen %1 to cover</source>
        <translation>es gibt keinen Bildschirm %1, der abgedeckt werden könnte</translation>
    </message>
    <message>
        <source>a screen other than the console&apos;s (screens of this computer: %1, numbered from 0)</source>
        <translation>ein anderer Bildschirm als der dieses Fensters (Bildschirme dieses Rechners: %1, gezählt ab 0)</translation>
    </message>
    <message>
        <source>connect the screen of the display, or leave &quot;cover&quot; out and stamp touches with the key T</source>
        <translation>schließen Sie den Bildschirm des Displays an, oder lassen Sie „cover“ weg und stempeln Sie Berührungen mit der Taste T</translation>
    </message>
    <message>
        <source>the screen of the display was disconnected</source>
        <translation>der Bildschirm des Displays wurde getrennt</translation>
    </message>
    <message>
        <source>a connected screen during the whole session</source>
        <translation>ein angeschlossener Bildschirm während des ganzen Versuchs</translation>
    </message>
    <message>
        <source>connect the screen, press Q to stop, and open the session again</source>
        <translation>schließen Sie den Bildschirm an, hören Sie mit Q auf und öffnen Sie den Versuch noch einmal</translation>
    </message>
    <message>
        <source>the display refuses: %1</source>
        <translation>das Display lehnt ab: %1</translation>
    </message>
    <message>
        <source>this display takes tickets only</source>
        <translation>dieses Display nimmt nur Scheine des Servers an</translation>
    </message>
    <message>
        <source>while an image was felt, the display&apos;s driver %1</source>
        <translation>während ein Bild gefühlt wurde: Der Treiber des Displays %1</translation>
    </message>
    <message>
        <source>the display&apos;s driver %1</source>
        <translation>der Treiber des Displays %1</translation>
    </message>
    <message>
        <source>the device&apos;s driver %1</source>
        <translation>der Treiber des Geräts %1</translation>
    </message>
    <message>
        <source>%1 (tried %2 times)</source>
        <translation>%1 (%2-mal versucht)</translation>
    </message>
    <message>
        <source>does not start: %1</source>
        <translation>startet nicht: %1</translation>
    </message>
    <message>
        <source>does not answer &quot;%1&quot; within %2</source>
        <translation>beantwortet „%1“ nicht innerhalb von %2</translation>
    </message>
    <message>
        <source>it sent instead: %1</source>
        <translation>er sandte stattdessen: %1</translation>
    </message>
    <message>
        <source>its error text: %1</source>
        <translation>sein Fehlertext: %1</translation>
    </message>
    <message>
        <source>cannot be started (%1)</source>
        <translation>lässt sich nicht starten (%1)</translation>
    </message>
    <message>
        <source>cannot be reached (%1)</source>
        <translation>ist nicht erreichbar (%1)</translation>
    </message>
    <message>
        <source>was stopped before it answered</source>
        <translation>wurde beendet, bevor er antwortete</translation>
    </message>
    <message>
        <source>sends more than was requested</source>
        <translation>sendet mehr als verlangt</translation>
    </message>
    <message>
        <source>closed its standard output</source>
        <translation>schloss seine Standardausgabe</translation>
    </message>
    <message>
        <source>closed the connection</source>
        <translation>schloss die Verbindung</translation>
    </message>
    <message>
        <source>was closed</source>
        <translation>wurde geschlossen</translation>
    </message>
    <message>
        <source>uses &quot;%1&quot;, but this program uses %2</source>
        <translation>benutzt „%1“, dieses Programm aber %2</translation>
    </message>
    <message>
        <source>this is no study folder (it has no study.db)</source>
        <translation>das ist kein Ordner einer Studie (study.db fehlt)</translation>
    </message>
    <message>
        <source>a folder made by vis2hap study new</source>
        <translation>ein Ordner, den vis2hap study new angelegt hat</translation>
    </message>
    <message>
        <source>check the path</source>
        <translation>prüfen Sie den Pfad</translation>
    </message>
    <message>
        <source>this is no SQLite database</source>
        <translation>das ist keine SQLite-Datenbank</translation>
    </message>
    <message>
        <source>the study.db of a study folder</source>
        <translation>die study.db eines Ordners einer Studie</translation>
    </message>
    <message>
        <source>the study has its own %1, but no %2</source>
        <translation>die Studie hat eigene Texte für %1, aber keine für %2</translation>
    </message>
    <message>
        <source>write them, too, so that every text describes the same ends of the scale</source>
        <translation>schreiben Sie auch diese, damit alle Texte dieselben Enden der Skala beschreiben</translation>
    </message>
    <message>
        <source>another program has the study open for writing (process %1)</source>
        <translation>ein anderes Programm hat die Studie zum Schreiben geöffnet (Prozess %1)</translation>
    </message>
    <message>
        <source>another program has the study open for writing</source>
        <translation>ein anderes Programm hat die Studie zum Schreiben geöffnet</translation>
    </message>
    <message>
        <source>one writer at a time</source>
        <translation>nur ein schreibendes Programm zur selben Zeit</translation>
    </message>
    <message>
        <source>close the study there first</source>
        <translation>schließen Sie die Studie zuerst dort</translation>
    </message>
    <message>
        <source>the lock of the study was deleted or replaced while it was open</source>
        <translation>die Sperre der Studie wurde gelöscht oder ersetzt, während sie offen war</translation>
    </message>
    <message>
        <source>close the study in every program, then open it again</source>
        <translation>schließen Sie die Studie in jedem Programm und öffnen Sie sie dann wieder</translation>
    </message>
    <message>
        <source>every stored answer is in it</source>
        <translation>jede gespeicherte Antwort ist darin</translation>
    </message>
    <message>
        <source>another computer has the study open for writing, or its program ended without closing it (process %1)</source>
        <translation>ein anderer Computer hat die Studie zum Schreiben geöffnet, oder sein Programm endete, ohne sie zu schließen (Prozess %1)</translation>
    </message>
    <message>
        <source>one computer at a time on a disk that other computers may use</source>
        <translation>nur ein Computer zur selben Zeit auf einer Netzwerkfreigabe</translation>
    </message>
    <message>
        <source>close the study there</source>
        <translation>schließen Sie die Studie dort</translation>
    </message>
    <message>
        <source>where it is closed for certain, delete %1 and do it again</source>
        <translation>wenn sie dort sicher geschlossen ist, löschen Sie %1 und wiederholen Sie den Schritt</translation>
    </message>
    <message>
        <source>the file system does not say whether the database is in its place (%1)</source>
        <translation>das Dateisystem sagt nicht, ob die Datenbank an ihrem Platz ist (%1)</translation>
    </message>
    <message>
        <source>a disk or a network share that answers</source>
        <translation>ein Datenträger oder eine Netzwerkfreigabe, die antwortet</translation>
    </message>
    <message>
        <source>check it and do the step again</source>
        <translation>prüfen Sie das und wiederholen Sie den Schritt</translation>
    </message>
    <message>
        <source>the study cannot be opened for writing: %1</source>
        <translation>die Studie lässt sich nicht zum Schreiben öffnen: %1</translation>
    </message>
    <message>
        <source>a folder that may be written</source>
        <translation>ein Ordner, in den geschrieben werden darf</translation>
    </message>
    <message>
        <source>check its permissions and its file system</source>
        <translation>prüfen Sie seine Rechte und sein Dateisystem</translation>
    </message>
    <message>
        <source>the folder holds a study already</source>
        <translation>der Ordner enthält schon eine Studie</translation>
    </message>
    <message>
        <source>a new folder</source>
        <translation>ein neuer Ordner</translation>
    </message>
    <message>
        <source>choose another name</source>
        <translation>wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>a newer version of this program made the study (schema %1)</source>
        <translation>eine neuere Version dieses Programms hat die Studie angelegt (Schema %1)</translation>
    </message>
    <message>
        <source>schema %1 or older</source>
        <translation>Schema %1 oder älter</translation>
    </message>
    <message>
        <source>update this program</source>
        <translation>aktualisieren Sie dieses Programm</translation>
    </message>
    <message>
        <source>the database of the study was deleted, replaced, overwritten or moved while it was open</source>
        <translation>die Datenbank der Studie wurde gelöscht, ersetzt, überschrieben oder verschoben, während sie offen war</translation>
    </message>
    <message>
        <source>the file that the session began with</source>
        <translation>die Datei, mit der der Versuch begann</translation>
    </message>
    <message>
        <source>every stored answer is kept in %1</source>
        <translation>jede gespeicherte Antwort steht in %1</translation>
    </message>
    <message>
        <source>close the study, then run vis2hap rescue %1</source>
        <translation>schließen Sie die Studie und rufen Sie dann vis2hap rescue %1 auf</translation>
    </message>
    <message>
        <source>the protocol was changed after the study was made</source>
        <translation>das Protokoll wurde geändert, nachdem die Studie angelegt war</translation>
    </message>
    <message>
        <source>the protocol cannot be read</source>
        <translation>das Protokoll lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>the text in the database</source>
        <translation>der Text in der Datenbank</translation>
    </message>
    <message>
        <source>accept the change with `%1`, or restore the text with `%2`</source>
        <translation>nehmen Sie die Änderung mit `%1` an, oder stellen Sie den Text mit `%2` wieder her</translation>
    </message>
    <message>
        <source>run vis2hap verify on the study</source>
        <translation>rufen Sie vis2hap verify für die Studie auf</translation>
    </message>
    <message>
        <source>restore it from a backup</source>
        <translation>stellen Sie die Datei aus einer Sicherung wieder her</translation>
    </message>
    <message>
        <source>the file from the making of the study</source>
        <translation>die Datei vom Anlegen der Studie</translation>
    </message>
    <message>
        <source>vis2hap verify lists all faults</source>
        <translation>vis2hap verify nennt alle Fehler</translation>
    </message>
    <message>
        <source>there is no such folder</source>
        <translation>diesen Ordner gibt es nicht</translation>
    </message>
    <message>
        <source>a folder that exists</source>
        <translation>ein vorhandener Ordner</translation>
    </message>
    <message>
        <source>choose another folder</source>
        <translation>wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>nothing was written</source>
        <translation>nichts wurde geschrieben</translation>
    </message>
    <message>
        <source>the files would lie in the study</source>
        <translation>die Dateien lägen in der Studie</translation>
    </message>
    <message>
        <source>a folder outside %1</source>
        <translation>ein Ordner außerhalb von %1</translation>
    </message>
    <message>
        <source>Open the pages in a browser and print them.</source>
        <translation>Öffnen Sie die Seiten in einem Browser und drucken Sie sie.</translation>
    </message>
    <message>
        <source>%1 of %2 answers (%3) came within %4 s of the touch</source>
        <translation>%1 von %2 Antworten (%3) kamen innerhalb von %4 s nach der Berührung</translation>
    </message>
    <message>
        <source>%1: %2 of %3 ratings are %4</source>
        <translation>%1: %2 von %3 Bewertungen sind %4</translation>
    </message>
    <message>
        <source>a participant who feels no difference also gives such ratings</source>
        <translation>auch wer keinen Unterschied fühlt, bewertet so</translation>
    </message>
    <message>
        <source>%1 of %2 presentations got the same number for every question</source>
        <translation>bei %1 von %2 Darbietungen war die Zahl für alle Fragen gleich</translation>
    </message>
    <message>
        <source>%1: %2 was chosen in %3 of %4 trials (p %5)</source>
        <translation>%1: %2 wurde in %3 von %4 Darbietungen gewählt (p %5)</translation>
    </message>
    <message>
        <source>tray slot %1</source>
        <translation>Feld %1 des Tabletts</translation>
    </message>
    <message>
        <source>the answer &quot;%1&quot;</source>
        <translation>die Antwort „%1“</translation>
    </message>
    <message>
        <source>%1: %2 was given in all %3 trials</source>
        <translation>%1: %2 kam in allen %3 Darbietungen</translation>
    </message>
    <message>
        <source>%1 ratings of %2 have at least the mean of the renderings&apos; ratings</source>
        <translation>%1 Bewertungen von %2 liegen im Mittel nicht unter denen der Reibungsbilder</translation>
    </message>
    <message>
        <source>blank glass (catch trials)</source>
        <translation>leerem Glas (Kontrolldarbietungen)</translation>
    </message>
    <message>
        <source>mismatched presentations (another fabric)</source>
        <translation>Darbietungen mit einem anderen Stoff</translation>
    </message>
    <message>
        <source>mismatch_rated_high</source>
        <translation>anderer Stoff hoch bewertet</translation>
    </message>
    <message>
        <source>too_fast</source>
        <translation>zu schnell</translation>
    </message>
    <message>
        <source>straight_lining</source>
        <translation>immer dieselbe Zahl</translation>
    </message>
    <message>
        <source>same_across_questions</source>
        <translation>gleich über alle Fragen</translation>
    </message>
    <message>
        <source>slot_bias</source>
        <translation>bevorzugtes Feld</translation>
    </message>
    <message>
        <source>blank_glass_rated_high</source>
        <translation>leeres Glas hoch bewertet</translation>
    </message>
    <message>
        <source>reading the protocol, drawing samples</source>
        <translation>Protokoll lesen, Aufnahmen ziehen</translation>
    </message>
    <message>
        <source>the hash of the data set</source>
        <translation>Prüfsumme des Datensatzes</translation>
    </message>
    <message>
        <source>signals and friction images</source>
        <translation>Signale und Reibungsbilder</translation>
    </message>
    <message>
        <source>comparison of signals</source>
        <translation>Vergleich der Signale</translation>
    </message>
    <message>
        <source>images for familiarisation</source>
        <translation>Bilder zur Eingewöhnung</translation>
    </message>
    <message>
        <source>photographs written</source>
        <translation>Fotos geschrieben</translation>
    </message>
    <message>
        <source>%1 is unusual for cloth (one drawn cloth in twenty is like it)</source>
        <translation>%1 ist für einen Stoff ungewöhnlich (wie einer von zwanzig gezeichneten Stoffen)</translation>
    </message>
    <message>
        <source>its height and friction are doubtful</source>
        <translation>Höhe und Reibung sind zweifelhaft</translation>
    </message>
    <message>
        <source>the scale is unknown</source>
        <translation>der Maßstab ist unbekannt</translation>
    </message>
    <message>
        <source>%1 per pixel is assumed, as if its threads were those of ordinary clothing</source>
        <translation>angenommen sind %1 je Pixel, als wären die Fäden die gewöhnlicher Kleidung</translation>
    </message>
    <message>
        <source>its weave repeats every %1, finer than cloth is (%2)</source>
        <translation>das Gewebe wiederholt sich alle %1, feiner als Stoff ist (%2)</translation>
    </message>
    <message>
        <source>check the scale</source>
        <translation>prüfen Sie den Maßstab</translation>
    </message>
    <message>
        <source>the data set has too few fabrics for the paper&apos;s questions</source>
        <translation>der Datensatz hat zu wenige Stoffe für die Fragen des Artikels</translation>
    </message>
    <message>
        <source>%1 or more</source>
        <translation>%1 oder mehr</translation>
    </message>
    <message>
        <source>%1 fabrics</source>
        <translation>%1 Stoffe</translation>
    </message>
    <message>
        <source>add photographs, or make a new study with a protocol of your own</source>
        <translation>fügen Sie Fotos hinzu, oder legen Sie mit einem eigenen Protokoll eine neue Studie an</translation>
    </message>
    <message>
        <source>photograph %1 of %2</source>
        <translation>Foto %1 von %2</translation>
    </message>
    <message>
        <source>running orders</source>
        <translation>Abfolgen</translation>
    </message>
    <message>
        <source>sealing and writing</source>
        <translation>Versiegeln und Schreiben</translation>
    </message>
    <message>
        <source>the station key cannot be read</source>
        <translation>der Schlüssel des Arbeitsplatzes lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>the station key is not the one committed in the database</source>
        <translation>der Schlüssel des Arbeitsplatzes ist nicht der in der Datenbank verzeichnete</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>ist leer</translation>
    </message>
    <message>
        <source>has %1 bytes</source>
        <translation>hat %1 Bytes</translation>
    </message>
    <message>
        <source>is not UTF-8</source>
        <translation>ist kein UTF-8</translation>
    </message>
    <message>
        <source>begins with a dot</source>
        <translation>beginnt mit einem Punkt</translation>
    </message>
    <message>
        <source>begins with a dash</source>
        <translation>beginnt mit einem Strich</translation>
    </message>
    <message>
        <source>begins with a blank</source>
        <translation>beginnt mit einem Leerzeichen</translation>
    </message>
    <message>
        <source>ends with a blank</source>
        <translation>endet mit einem Leerzeichen</translation>
    </message>
    <message>
        <source>holds a control character</source>
        <translation>enthält ein Steuerzeichen</translation>
    </message>
    <message>
        <source>holds an invisible character</source>
        <translation>enthält ein unsichtbares Zeichen</translation>
    </message>
    <message>
        <source>holds a slash or backslash</source>
        <translation>enthält einen Schrägstrich</translation>
    </message>
    <message>
        <source>holds a comma</source>
        <translation>enthält ein Komma</translation>
    </message>
    <message>
        <source>stands for a missing value in tables</source>
        <translation>steht in Tabellen für einen fehlenden Wert</translation>
    </message>
    <message>
        <source>%1 to %2 bytes of UTF-8 without control or invisible characters, slashes, backslashes and commas, that begin with no dot, dash or blank and end with no blank</source>
        <translation>%1 bis %2 Bytes UTF-8 ohne Steuerzeichen, unsichtbare Zeichen, Schrägstriche und Kommas; sie beginnen nicht mit Punkt, Strich oder Leerzeichen und enden nicht mit einem Leerzeichen</translation>
    </message>
    <message>
        <source>%1 does not look like cloth</source>
        <translation>%1 sieht nicht nach Stoff aus</translation>
    </message>
    <message>
        <source>what is generated from it means nothing</source>
        <translation>was daraus erzeugt wird, bedeutet nichts</translation>
    </message>
    <message>
        <source>photograph %1 of %2 is unusual for cloth (one drawn cloth in twenty is like it)</source>
        <translation>Foto %1 von %2 ist für einen Stoff ungewöhnlich (wie einer von zwanzig gezeichneten Stoffen)</translation>
    </message>
    <message>
        <source>expected %1</source>
        <translation>erwartet: %1</translation>
    </message>
    <message>
        <source>signals of the same places</source>
        <translation>Signale derselben Stellen</translation>
    </message>
    <message>
        <source>signals of different places</source>
        <translation>Signale verschiedener Stellen</translation>
    </message>
    <message>
        <source>procedural, signals of the same places</source>
        <translation>erzeugt, Signale derselben Stellen</translation>
    </message>
    <message>
        <source>procedural, signals of different places</source>
        <translation>erzeugt, Signale verschiedener Stellen</translation>
    </message>
    <message>
        <source>photographs %1 mm per pixel</source>
        <translation>Fotos %1 mm je Pixel</translation>
    </message>
    <message>
        <source>frames %1 mm per pixel</source>
        <translation>Aufnahmen %1 mm je Pixel</translation>
    </message>
    <message>
        <source>photographs of unknown scale</source>
        <translation>Fotos mit unbekanntem Maßstab</translation>
    </message>
    <message>
        <source>frames of unknown scale</source>
        <translation>Aufnahmen mit unbekanntem Maßstab</translation>
    </message>
    <message>
        <source>strokes at %1 mm/s and %2 Hz</source>
        <translation>Striche mit %1 mm/s und %2 Hz</translation>
    </message>
    <message>
        <source>is empty, expected a name for the study</source>
        <translation>ist leer, erwartet: ein Name für die Studie</translation>
    </message>
    <message>
        <source>%1, expected at least %2</source>
        <translation>%1, erwartet: mindestens %2</translation>
    </message>
    <message>
        <source>%1 are named, expected %2</source>
        <translation>%1 sind genannt, erwartet: %2</translation>
    </message>
    <message>
        <source>is empty, expected the id of a fabric</source>
        <translation>ist leer, erwartet: die Kennung eines Stoffs</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected each fabric once</source>
        <translation>„%1“ ist zweimal genannt, erwartet: jeder Stoff einmal</translation>
    </message>
    <message>
        <source>is empty, expected at least one of %1</source>
        <translation>ist leer, erwartet: mindestens eine von %1</translation>
    </message>
    <message>
        <source>is empty, expected the folder of the images</source>
        <translation>ist leer, erwartet: der Ordner der Bilder</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected each condition once</source>
        <translation>„%1“ ist zweimal genannt, erwartet: jede Bedingung einmal</translation>
    </message>
    <message>
        <source>%1, expected at most the number of presentations in the phase</source>
        <translation>%1, erwartet: höchstens die Anzahl der Darbietungen in der Phase</translation>
    </message>
    <message>
        <source>%1 questions with a right answer, expected one (and any number in free_text)</source>
        <translation>%1 Fragen mit richtiger Antwort, erwartet: eine (und beliebig viele in eigenen Worten)</translation>
    </message>
    <message>
        <source>is empty, expected at least one question</source>
        <translation>ist leer, erwartet: mindestens eine Frage</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is asked twice, expected each question once</source>
        <translation>„%1“ wird zweimal gefragt, erwartet: jede Frage einmal</translation>
    </message>
    <message>
        <source>&apos;%1&apos; has no text, expected one in question_texts</source>
        <translation>„%1“ hat keinen Satz</translation>
    </message>
    <message>
        <source>is empty, expected a name such as &quot;speed&quot;</source>
        <translation>ist leer, erwartet: ein Name wie „speed“</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is named twice, expected ids that differ also when their case is ignored</source>
        <translation>„%1“ ist zweimal genannt, erwartet: Kennungen, die sich nicht nur in der Groß- und Kleinschreibung unterscheiden</translation>
    </message>
    <message>
        <source>expected 0.1 to 3600 seconds</source>
        <translation>erwartet: 0,1 bis 3600 Sekunden</translation>
    </message>
    <message>
        <source>is empty, expected the sentence that the operator says</source>
        <translation>ist leer, erwartet: der Satz, den die Versuchsleitung sagt</translation>
    </message>
    <message>
        <source>is empty, expected at least one phase</source>
        <translation>ist leer, erwartet: mindestens eine Phase</translation>
    </message>
    <message>
        <source>&apos;%1&apos; and &apos;%2&apos; are not a planned contrast in this order, expected a pair of planned</source>
        <translation>„%1“ und „%2“ sind in dieser Reihenfolge kein geplanter Kontrast, erwartet: ein Paar aus planned</translation>
    </message>
    <message>
        <source>is empty, expected the id of a condition</source>
        <translation>ist leer, erwartet: die Kennung einer Bedingung</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not among the conditions, expected a pair of the protocol&apos;s conditions</source>
        <translation>„%1“ ist nicht unter den Bedingungen, erwartet: ein Paar von Bedingungen des Protokolls</translation>
    </message>
    <message>
        <source>compares &apos;%1&apos; with itself, expected two conditions</source>
        <translation>vergleicht „%1“ mit sich selbst, erwartet: zwei Bedingungen</translation>
    </message>
    <message>
        <source>repeats an earlier contrast, expected each pair once</source>
        <translation>wiederholt einen früheren Kontrast, erwartet: jedes Paar einmal</translation>
    </message>
    <message>
        <source>the lower is not below the upper, expected [lower, upper]</source>
        <translation>die untere liegt nicht unter der oberen, erwartet: [untere, obere]</translation>
    </message>
    <message>
        <source>expected more than 0</source>
        <translation>erwartet: mehr als 0</translation>
    </message>
    <message>
        <source>expected at least 1 presentation</source>
        <translation>erwartet: mindestens 1 Darbietung</translation>
    </message>
    <message>
        <source>expected at least 1 minute</source>
        <translation>erwartet: mindestens 1 Minute</translation>
    </message>
    <message>
        <source>expected 0 to 5 seconds</source>
        <translation>erwartet: 0 bis 5 Sekunden</translation>
    </message>
    <message>
        <source>expected 0 or more</source>
        <translation>erwartet: 0 oder mehr</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is missing</source>
        <translation>„%1“ fehlt</translation>
    </message>
    <message>
        <source>unknown key &apos;%1&apos;</source>
        <translation>unbekannter Schlüssel „%1“</translation>
    </message>
    <message>
        <source>%1, expected %2</source>
        <translation>%1, erwartet: %2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is a column of exported answers, expected another id</source>
        <translation>„%1“ ist eine Spalte exportierter Antworten, erwartet: eine andere Kennung</translation>
    </message>
    <message>
        <source>the tray has one piece, expected a phase with alternatives</source>
        <translation>auf dem Tablett liegt eine Probe, erwartet: eine Phase mit alternatives</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not among the phase&apos;s questions</source>
        <translation>„%1“ ist nicht unter den Fragen der Phase</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is asked in no phase, expected ids of the phases&apos; questions</source>
        <translation>„%1“ wird in keiner Phase gefragt, erwartet: Kennungen der Fragen der Phasen</translation>
    </message>
    <message>
        <source>%1, expected a whole number of tenths</source>
        <translation>%1, erwartet: eine ganze Zahl von Zehnteln</translation>
    </message>
    <message>
        <source>%1, expected at most 26, for the slots A to Z</source>
        <translation>%1, erwartet: höchstens 26, für die Felder A bis Z</translation>
    </message>
    <message>
        <source>%1 of %2 fabrics, expected no more alternatives than fabrics</source>
        <translation>%1 von %2 Stoffen, erwartet: nicht mehr Alternativen als Stoffe</translation>
    </message>
    <message>
        <source>max is not above min, expected min &lt; max</source>
        <translation>das Maximum liegt nicht über dem Minimum, erwartet: min &lt; max</translation>
    </message>
    <message>
        <source>is not positive, expected at least 0.1</source>
        <translation>ist nicht positiv, erwartet: mindestens 0,1</translation>
    </message>
    <message>
        <source>does not lead from min to max, expected a whole number of steps</source>
        <translation>führt nicht vom Minimum zum Maximum, erwartet: eine ganze Zahl von Schritten</translation>
    </message>
    <message>
        <source>%1 words, expected %2</source>
        <translation>%1 Wörter, erwartet: %2</translation>
    </message>
    <message>
        <source>one fabric, expected at least 2, so that some can differ</source>
        <translation>ein Stoff, erwartet: mindestens 2, damit manche verschieden sein können</translation>
    </message>
    <message>
        <source>presentations of a rendering per participant</source>
        <translation>Darbietungen eines Reibungsbilds je Versuchsperson</translation>
    </message>
    <message>
        <source>ordered pairs of conditions</source>
        <translation>geordnete Paare von Bedingungen</translation>
    </message>
    <message>
        <source>ordered pairs of fabrics</source>
        <translation>geordnete Paare von Stoffen</translation>
    </message>
    <message>
        <source>a condition per stretch of the order</source>
        <translation>eine Bedingung je Abschnitt der Abfolge</translation>
    </message>
    <message>
        <source>a fabric per stretch of the order</source>
        <translation>ein Stoff je Abschnitt der Abfolge</translation>
    </message>
    <message>
        <source>foil sets per true fabric</source>
        <translation>Sätze von Ablenkern je richtigem Stoff</translation>
    </message>
    <message>
        <source>true slots per participant and fabric</source>
        <translation>richtige Felder je Versuchsperson und Stoff</translation>
    </message>
    <message>
        <source>true slots per condition</source>
        <translation>richtige Felder je Bedingung</translation>
    </message>
    <message>
        <source>a fabric as foil per participant</source>
        <translation>ein Stoff als Ablenker je Versuchsperson</translation>
    </message>
    <message>
        <source>slots of a foil per participant</source>
        <translation>Felder eines Ablenkers je Versuchsperson</translation>
    </message>
    <message>
        <source>The server has not given out this presentation yet.</source>
        <translation>Der Server hat diese Darbietung noch nicht ausgegeben.</translation>
    </message>
    <message>
        <source>the server cannot be reached</source>
        <translation>der Server ist nicht erreichbar</translation>
    </message>
    <message>
        <source>the server cannot be reached: %1</source>
        <translation>der Server ist nicht erreichbar: %1</translation>
    </message>
    <message>
        <source>wait until it can be reached again, then go on</source>
        <translation>warten Sie, bis er wieder erreichbar ist, und machen Sie dann weiter</translation>
    </message>
    <message>
        <source>the connection to the server ended (%1)</source>
        <translation>die Verbindung zum Server ist abgebrochen (%1)</translation>
    </message>
    <message>
        <source>the server does not answer</source>
        <translation>der Server antwortet nicht</translation>
    </message>
    <message>
        <source>check the network and the server</source>
        <translation>prüfen Sie Netz und Server</translation>
    </message>
    <message>
        <source>the server refused this login: %1</source>
        <translation>der Server hat diese Anmeldung abgelehnt: %1</translation>
    </message>
    <message>
        <source>the server refused user or password: %1</source>
        <translation>der Server hat Benutzer oder Passwort abgelehnt: %1</translation>
    </message>
    <message>
        <source>the server has too many connections: %1</source>
        <translation>der Server hat zu viele Verbindungen: %1</translation>
    </message>
    <message>
        <source>the server stops: %1</source>
        <translation>der Server wird beendet: %1</translation>
    </message>
    <message>
        <source>the server takes no connections now: %1</source>
        <translation>der Server nimmt zurzeit keine Verbindungen an: %1</translation>
    </message>
    <message>
        <source>there is no password for this login: %1</source>
        <translation>für diese Anmeldung gibt es kein Passwort: %1</translation>
    </message>
    <message>
        <source>the server does not encrypt: %1</source>
        <translation>der Server verschlüsselt nicht: %1</translation>
    </message>
    <message>
        <source>the certificate of the server is not accepted here: %1</source>
        <translation>das Zertifikat des Servers wird hier nicht anerkannt: %1</translation>
    </message>
    <message>
        <source>the certificate belongs to another server: %1</source>
        <translation>das Zertifikat gehört einem anderen Server: %1</translation>
    </message>
    <message>
        <source>the certificate of the lab&apos;s authority cannot be read: %1</source>
        <translation>das Zertifikat der Zertifizierungsstelle ist nicht lesbar: %1</translation>
    </message>
    <message>
        <source>the key of this login cannot be used: %1</source>
        <translation>der Schlüssel dieser Anmeldung ist nicht verwendbar: %1</translation>
    </message>
    <message>
        <source>the server wants a certificate of this login: %1</source>
        <translation>der Server verlangt ein Zertifikat dieser Anmeldung: %1</translation>
    </message>
    <message>
        <source>the server refused the encryption: %1</source>
        <translation>der Server hat die Verschlüsselung abgelehnt: %1</translation>
    </message>
    <message>
        <source>a certificate cannot be used: %1</source>
        <translation>ein Zertifikat ist nicht verwendbar: %1</translation>
    </message>
    <message>
        <source>the service is unknown: %1</source>
        <translation>der Dienst ist unbekannt: %1</translation>
    </message>
    <message>
        <source>the service file cannot be read: %1</source>
        <translation>die Dienstdatei ist nicht lesbar: %1</translation>
    </message>
    <message>
        <source>a setting of the address is wrong: %1</source>
        <translation>eine Einstellung der Adresse ist falsch: %1</translation>
    </message>
    <message>
        <source>hosts and ports do not agree: %1</source>
        <translation>Hosts und Ports passen nicht zusammen: %1</translation>
    </message>
    <message>
        <source>no server of the list takes entries: %1</source>
        <translation>kein Server der Liste nimmt Einträge an: %1</translation>
    </message>
    <message>
        <source>all slots of the study are taken</source>
        <translation>alle Plätze der Studie sind vergeben</translation>
    </message>
    <message>
        <source>The server refused answers of %1 that waited here (%2). They are kept in %3.</source>
        <translation>Der Server hat Antworten von %1 abgelehnt, die hier gewartet haben (%2). Sie liegen in %3.</translation>
    </message>
    <message>
        <source>the server takes nothing from this station now (%1)</source>
        <translation>der Server nimmt von dieser Station zurzeit nichts an (%1)</translation>
    </message>
    <message>
        <source>remove the cause, then go on</source>
        <translation>beheben Sie die Ursache und fahren Sie dann fort</translation>
    </message>
    <message>
        <source>the server lost entries of %1 (%2), so this session cannot go on</source>
        <translation>dem Server fehlen Einträge von %1 (%2), deshalb kann diese Sitzung nicht weitergehen</translation>
    </message>
    <message>
        <source>the server gained entries of %1 (%2), so this session cannot go on</source>
        <translation>der Server hat neue Einträge von %1 (%2), deshalb kann diese Sitzung nicht weitergehen</translation>
    </message>
    <message>
        <source>the server has other entries of %1, so this session cannot go on</source>
        <translation>der Server hat andere Einträge von %1, deshalb kann diese Sitzung nicht weitergehen</translation>
    </message>
    <message>
        <source>the server refused entries of %1, so this session cannot go on</source>
        <translation>der Server hat Einträge von %1 abgelehnt, deshalb kann diese Sitzung nicht weitergehen</translation>
    </message>
    <message>
        <source>the log that this station holds, kept in this file</source>
        <translation>das Protokoll dieser Station, das in dieser Datei liegt</translation>
    </message>
    <message>
        <source>open the participant again</source>
        <translation>öffnen Sie die Sitzung der Person noch einmal</translation>
    </message>
    <message>
        <source>%1 was enrolled at another station in the meantime</source>
        <translation>%1 wurde inzwischen an einer anderen Station aufgenommen</translation>
    </message>
    <message>
        <source>participant %1 has withdrawn</source>
        <translation>Versuchsperson %1 ist zurückgetreten</translation>
    </message>
    <message>
        <source>a code that nobody has</source>
        <translation>ein Kürzel, das niemand hat</translation>
    </message>
    <message>
        <source>type the next free code, or choose the participant in the list</source>
        <translation>geben Sie das nächste freie Kürzel ein, oder wählen Sie die Person in der Liste</translation>
    </message>
    <message>
        <source>type the next free code</source>
        <translation>tippen Sie das nächste freie Kürzel</translation>
    </message>
    <message>
        <source>the server lost entries after entry %1, so codes of participants may be lost, too</source>
        <translation>dem Server fehlen Einträge nach Eintrag %1, deshalb können auch Codes von Teilnehmenden fehlen</translation>
    </message>
    <message>
        <source>ask the study&apos;s owner</source>
        <translation>fragen Sie die Leitung der Studie</translation>
    </message>
    <message>
        <source>if the owner agrees, enrol %1 once more</source>
        <translation>ist die Leitung einverstanden, nehmen Sie %1 noch einmal auf</translation>
    </message>
    <message>
        <source>the server has another study of this name than before</source>
        <translation>der Server hat eine andere Studie dieses Namens als zuvor</translation>
    </message>
    <message>
        <source>move this folder elsewhere to join the other study</source>
        <translation>verschieben Sie diesen Ordner, um an der anderen Studie teilzunehmen</translation>
    </message>
    <message>
        <source>%1 entries for another address wait in the folder of this station</source>
        <translation>im Ordner dieser Station warten %1 Einträge, die für eine andere Adresse bestimmt sind</translation>
    </message>
    <message>
        <source>signals of %1</source>
        <translation>Signale von %1</translation>
    </message>
    <message>
        <source>generating</source>
        <translation>die Signale werden erzeugt</translation>
    </message>
    <message>
        <source>composing</source>
        <translation>die Reibungsbilder werden zusammengesetzt</translation>
    </message>
    <message>
        <source>generated against measured</source>
        <translation>erzeugte Signale werden mit gemessenen verglichen</translation>
    </message>
    <message>
        <source>training photographs for retrieval</source>
        <translation>Trainingsfotos für den Vergleich werden gelesen</translation>
    </message>
    <message>
        <source>open the folder itself, so that they are sent</source>
        <translation>öffnen Sie den Ordner selbst, damit sie gesendet werden</translation>
    </message>
    <message>
        <source>if its address is gone, move it elsewhere and give it to the study&apos;s owner</source>
        <translation>gibt es seine Adresse nicht mehr, verschieben Sie ihn und geben Sie ihn der Leitung der Studie</translation>
    </message>
    <message>
        <source>give the file to the study&apos;s owner, then open the address again</source>
        <translation>geben Sie die Datei der Leitung der Studie und öffnen Sie dann die Adresse noch einmal</translation>
    </message>
    <message>
        <source>the computer starts no further work</source>
        <translation>der Computer beginnt keine weitere Arbeit</translation>
    </message>
    <message>
        <source>memory and room for one more thread</source>
        <translation>Speicher und Platz für einen weiteren Thread</translation>
    </message>
    <message>
        <source>close other programs, then try again</source>
        <translation>schließen Sie andere Programme und versuchen Sie es dann noch einmal</translation>
    </message>
</context>
<context>
    <name>study::app::Catalogue</name>
    <message>
        <source>name of the language</source>
        <extracomment>The name of your language in your language, such as &quot;Deutsch&quot;.</extracomment>
        <translation>Deutsch</translation>
    </message>
    <message>
        <source>reviewer</source>
        <extracomment>The native speaker who has checked the catalogue. Leave it empty until somebody has.</extracomment>
        <translation></translation>
    </message>
    <message>
        <source>version of the program</source>
        <extracomment>The version of the program that the catalogue is made for, such as &quot;0.6.0&quot;.</extracomment>
        <translation>0.6.0</translation>
    </message>
</context>
<context>
    <name>study::app::CheckPanel</name>
    <message>
        <source>“%1” has no sentence</source>
        <translation>„%1“ hat keinen Satz</translation>
    </message>
    <message>
        <source>%1 questions have a right answer, expected one; others can be answered in own words</source>
        <translation>%1 Fragen haben eine richtige Antwort, erwartet wird eine; andere können in eigenen Worten beantwortet werden</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>Line %1, column %2. %3</source>
        <translation>Zeile %1, Spalte %2. %3</translation>
    </message>
    <message>
        <source>No fault</source>
        <translation>Kein Fehler</translation>
    </message>
    <message>
        <source>1 fault</source>
        <translation>1 Fehler</translation>
    </message>
    <message>
        <source>%1 faults</source>
        <translation>%1 Fehler</translation>
    </message>
    <message>
        <source>Remove it</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Go to</source>
        <translation>Dorthin</translation>
    </message>
    <message>
        <source>Remove it: %1</source>
        <translation>Entfernen: %1</translation>
    </message>
    <message>
        <source>Go to: %1</source>
        <translation>Dorthin: %1</translation>
    </message>
    <message>
        <source>… and %1 more</source>
        <translation>… und %1 weitere</translation>
    </message>
    <message>
        <source>No fault. Presentations: %1, minutes: %2, sittings: %3</source>
        <translation>Kein Fehler. Darbietungen: %1, Minuten: %2, Sitzungen: %3</translation>
    </message>
    <message>
        <source>Minutes, power and the preview follow when there is no fault.</source>
        <translation>Minuten, Power und Vorschau folgen, sobald es keinen Fehler gibt.</translation>
    </message>
    <message>
        <source>Each participant: about %1 minutes without breaks. Presentations: %2, answers: %3, breaks: %4, sittings: %5. The whole study: answers: %6.</source>
        <translation>Jede Versuchsperson: etwa %1 Minuten ohne Pausen. Darbietungen: %2, Antworten: %3, Pausen: %4, Sitzungen: %5. Die ganze Studie: Antworten: %6.</translation>
    </message>
    <message>
        <source>Power and balance are being computed …</source>
        <translation>Power und Ausgewogenheit werden berechnet …</translation>
    </message>
    <message>
        <source>%1: a difference of %2 scale points between two conditions</source>
        <translation>%1: einen Unterschied von %2 Skalenpunkten zwischen zwei Bedingungen</translation>
    </message>
    <message>
        <source>%1: %2 % right answers in one condition</source>
        <translation>%1: %2 % richtige Antworten in einer Bedingung</translation>
    </message>
    <message>
        <source>With a power of 80 %, under the usual assumptions, the study detects:</source>
        <translation>Mit einer Power von 80 % entdeckt die Studie unter den üblichen Annahmen:</translation>
    </message>
    <message>
        <source>%1: %2 to %3</source>
        <translation>%1: %2 bis %3</translation>
    </message>
    <message>
        <source>Balance of the running orders:</source>
        <translation>Ausgewogenheit der Abfolgen:</translation>
    </message>
    <message>
        <source>Orders of this length take long to draw; `vis2hap protocol show` prints their balance.</source>
        <translation>Abfolgen dieser Länge brauchen lange; `vis2hap protocol show` gibt ihre Ausgewogenheit aus.</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>%1 is missing</source>
        <translation>%1 fehlt</translation>
    </message>
    <message>
        <source>%1: none yet</source>
        <translation>%1: noch nichts gewählt</translation>
    </message>
</context>
<context>
    <name>study::app::ChecklistPage</name>
    <message>
        <source>Everything is ready (Enter)</source>
        <translation>Alles ist bereit (Enter)</translation>
    </message>
    <message>
        <source>Before the first presentation</source>
        <translation>Vor der ersten Darbietung</translation>
    </message>
    <message>
        <source>Work through the list. Press Space to tick a line. The program stores the time when you finish.</source>
        <translation>Gehen Sie die Liste durch. Haken Sie jede Zeile mit der Leertaste ab. Das Programm speichert, wann Sie fertig sind.</translation>
    </message>
    <message>
        <source>This display takes its images from the server only, so it plays no test patterns.</source>
        <translation>Dieses Display nimmt nur die Bilder des Servers an und zeigt daher keine Testmuster.</translation>
    </message>
    <message>
        <source>Feel the test pattern:</source>
        <translation>Fühlen Sie das Testmuster:</translation>
    </message>
    <message>
        <source>Feel the test pattern. Gratings need the width of a pixel from the display page.</source>
        <translation>Fühlen Sie das Testmuster. Gitter brauchen die Breite eines Pixels von der Seite „Display“.</translation>
    </message>
    <message>
        <source>This line is not ticked yet: %1. Check it, then press Space.</source>
        <translation>Diese Zeile ist noch nicht abgehakt: %1. Prüfen Sie sie und drücken Sie dann die Leertaste.</translation>
    </message>
    <message>
        <source>Nothing is written for “%1”. Press Enter again to go on without it.</source>
        <translation>Bei „%1“ steht nichts. Drücken Sie noch einmal Enter, um ohne diesen Wert fortzufahren.</translation>
    </message>
    <message>
        <source>“%1” is not a number. Press Enter again to store it.</source>
        <translation>„%1“ ist keine Zahl. Drücken Sie noch einmal Enter, um es zu speichern.</translation>
    </message>
</context>
<context>
    <name>study::app::ChoiceControls</name>
    <message>
        <source>Answers to choose by letter</source>
        <translation>Antworten, nach Buchstaben zu wählen</translation>
    </message>
    <message>
        <source>No answer is chosen. Press the letter that the participant says.</source>
        <translation>Es ist keine Antwort gewählt. Drücken Sie den Buchstaben, den die Versuchsperson sagt.</translation>
    </message>
    <message>
        <source>Press the letter that the participant says.</source>
        <translation>Drücken Sie den Buchstaben, den die Versuchsperson sagt.</translation>
    </message>
    <message>
        <source>Read back: %1</source>
        <translation>Lesen Sie vor: %1</translation>
    </message>
</context>
<context>
    <name>study::app::ConditionsSection</name>
    <message>
        <source>The brightness of the photograph is felt as relief.</source>
        <translation>Die Helligkeit des Fotos ist als Relief zu fühlen.</translation>
    </message>
    <message>
        <source>Relief that is computed from the shading of the photograph.</source>
        <translation>Relief, das aus der Schattierung des Fotos berechnet wird.</translation>
    </message>
    <message>
        <source>Friction along the stroke, generated from the photograph.</source>
        <translation>Reibung entlang des Strichs, aus dem Foto erzeugt.</translation>
    </message>
    <message>
        <source>Relief that is generated from the photograph.</source>
        <translation>Relief, das aus dem Foto erzeugt wird.</translation>
    </message>
    <message>
        <source>Relief and mean friction, both generated from the photograph.</source>
        <translation>Relief und mittlere Reibung, beide aus dem Foto erzeugt.</translation>
    </message>
    <message>
        <source>The brightness of a tactile sensor&apos;s picture is felt as relief.</source>
        <translation>Die Helligkeit der Aufnahme eines Tastsensors ist als Relief zu fühlen.</translation>
    </message>
    <message>
        <source>Friction that was measured along a stroke.</source>
        <translation>Reibung, die entlang eines Strichs gemessen wurde.</translation>
    </message>
    <message>
        <source>Relief that was measured with a tactile sensor.</source>
        <translation>Relief, das mit einem Tastsensor gemessen wurde.</translation>
    </message>
    <message>
        <source>Relief and mean friction, both measured.</source>
        <translation>Relief und mittlere Reibung, beide gemessen.</translation>
    </message>
    <message>
        <source>Slope of the measured relief along the stroke; not in the paper.</source>
        <translation>Steigung des gemessenen Reliefs entlang des Strichs; nicht im Artikel.</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Name of your condition</source>
        <translation>Name Ihrer Bedingung</translation>
    </message>
    <message>
        <source>Folder of its images</source>
        <translation>Ordner ihrer Bilder</translation>
    </message>
    <message>
        <source>Add your images</source>
        <translation>Ihre Bilder hinzufügen</translation>
    </message>
    <message>
        <source>Add your program</source>
        <translation>Ihr Programm hinzufügen</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Condition at another quality</source>
        <translation>Bedingung in anderer Qualität</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Add this quality</source>
        <translation>Diese Qualität hinzufügen</translation>
    </message>
    <message>
        <source>Conditions</source>
        <translation>Bedingungen</translation>
    </message>
    <message>
        <source>Ways to turn a fabric into what the finger feels on the screen.</source>
        <translation>Wege von einem Stoff zu dem, was der Finger auf dem Bildschirm fühlt.</translation>
    </message>
    <message>
        <source>Condition %1: %2</source>
        <translation>Bedingung %1: %2</translation>
    </message>
    <message>
        <source>Your own conditions</source>
        <translation>Ihre eigenen Bedingungen</translation>
    </message>
    <message>
        <source>A folder with one ready friction image a fabric: F01.png, F02.png, … Or a program, which you name when you make the study with `vis2hap study new --program`. They are blinded and balanced like all others.</source>
        <translation>Ein Ordner mit einem fertigen Reibungsbild je Stoff: F01.png, F02.png, … Oder ein Programm, das Sie beim Anlegen der Studie mit `vis2hap study new --program` nennen. Sie werden verblindet und ausgewogen wie alle anderen.</translation>
    </message>
    <message>
        <source>Further conditions of the study</source>
        <translation>Weitere Bedingungen der Studie</translation>
    </message>
    <message>
        <source>mine</source>
        <translation>meine</translation>
    </message>
    <message>
        <source>the folder with the images</source>
        <translation>der Ordner mit den Bildern</translation>
    </message>
    <message>
        <source>One condition at several qualities</source>
        <translation>Eine Bedingung in mehreren Qualitäten</translation>
    </message>
    <message>
        <source>Quality trades computing time for exactness, so a study can compare its prices.</source>
        <translation>Qualität tauscht Rechenzeit gegen Genauigkeit; eine Studie kann ihre Preise vergleichen.</translation>
    </message>
    <message>
        <source>%1    by a program</source>
        <translation>%1    von einem Programm</translation>
    </message>
    <message>
        <source>%1    from %2</source>
        <translation>%1    aus %2</translation>
    </message>
    <message>
        <source>Folder of the images</source>
        <translation>Ordner der Bilder</translation>
    </message>
    <message>
        <source>Your condition has no name. Type one, such as mine.</source>
        <translation>Ihre Bedingung hat keinen Namen. Tippen Sie einen, zum Beispiel meine.</translation>
    </message>
    <message>
        <source>No folder is given. Choose the folder that holds one image a fabric.</source>
        <translation>Es ist kein Ordner angegeben. Wählen Sie den Ordner, der je Stoff ein Bild enthält.</translation>
    </message>
</context>
<context>
    <name>study::app::ConnectingPage</name>
    <message>
        <source>Stop (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Connecting the display…</source>
        <translation>Das Display wird verbunden …</translation>
    </message>
    <message>
        <source>%1 has up to 10 seconds to answer.</source>
        <translation>%1 hat bis zu 10 Sekunden Zeit zu antworten.</translation>
    </message>
</context>
<context>
    <name>study::app::CorrectionPanel</name>
    <message>
        <source>Question</source>
        <translation>Frage</translation>
    </message>
    <message>
        <source>Stored answer</source>
        <translation>Gespeicherte Antwort</translation>
    </message>
    <message>
        <source>New answer</source>
        <translation>Neue Antwort</translation>
    </message>
    <message>
        <source>Correct an answer</source>
        <translation>Antwort berichtigen</translation>
    </message>
    <message>
        <source>The study keeps the old answer beside the new one.</source>
        <translation>Die Studie bewahrt die alte Antwort neben der neuen auf.</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Store the correction (Enter)</source>
        <translation>Berichtigung speichern (Enter)</translation>
    </message>
    <message>
        <source>Write a short reason, such as “misheard”. Press Enter again to store the correction without a reason.</source>
        <translation>Schreiben Sie einen kurzen Grund, zum Beispiel „verhört“. Drücken Sie noch einmal Enter, um ohne Grund zu speichern.</translation>
    </message>
    <message>
        <source>%1 is the stored answer. Choose another answer, or press Esc to go back.</source>
        <translation>%1 ist die gespeicherte Antwort. Wählen Sie eine andere Antwort, oder drücken Sie Esc, um zurückzugehen.</translation>
    </message>
    <message>
        <source>Correct the answer to %1</source>
        <translation>Antwort auf %1 berichtigen</translation>
    </message>
</context>
<context>
    <name>study::app::DataPage</name>
    <message>
        <source>Folder of the data set</source>
        <translation>Ordner des Datensatzes</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Open the data set (Enter)</source>
        <translation>Datensatz öffnen (Enter)</translation>
    </message>
    <message>
        <source>Previous (Page Up)</source>
        <translation>Vorige (Bild auf)</translation>
    </message>
    <message>
        <source>Next (Page Down)</source>
        <translation>Nächste (Bild ab)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Fabrics of the data set</source>
        <translation>Stoffe des Datensatzes</translation>
    </message>
    <message>
        <source>Fabric</source>
        <translation>Stoff</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotos</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>Heights</source>
        <translation>Höhen</translation>
    </message>
    <message>
        <source>Strokes</source>
        <translation>Striche</translation>
    </message>
    <message>
        <source>Faults</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Faults found in the files</source>
        <translation>In den Dateien gefundene Fehler</translation>
    </message>
    <message>
        <source>Choose a fabric: arrow keys in the list   ·   scroll the page: Ctrl ↑ and Ctrl ↓</source>
        <translation>Stoff wählen: Pfeiltasten in der Liste   ·   Seite verschieben: Strg ↑ und Strg ↓</translation>
    </message>
    <message>
        <source>Look at a data set</source>
        <translation>Datensatz ansehen</translation>
    </message>
    <message>
        <source>Check the data before the first participant comes. This page shows bad presses and clipped images.</source>
        <translation>Prüfen Sie die Daten, bevor die erste Versuchsperson kommt. Diese Seite zeigt misslungene Abdrücke und übersteuerte Bilder.</translation>
    </message>
    <message>
        <source>the folder that contains dataset.json</source>
        <translation>der Ordner, der dataset.json enthält</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>Stoff-Datensatz</translation>
    </message>
    <message>
        <source>No folder is given. Type the folder of the data set, or choose it with Browse.</source>
        <translation>Es ist kein Ordner angegeben. Tippen Sie den Ordner des Datensatzes oder wählen Sie ihn mit „Durchsuchen“.</translation>
    </message>
    <message>
        <source>The program reads the data set.</source>
        <translation>Das Programm liest den Datensatz.</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>The program checks every file.</source>
        <translation>Das Programm prüft jede Datei.</translation>
    </message>
    <message>
        <source>The program checks every file: %1 % done.</source>
        <translation>Das Programm prüft jede Datei: %1 % erledigt.</translation>
    </message>
    <message>
        <source>All files are valid.</source>
        <translation>Alle Dateien sind in Ordnung.</translation>
    </message>
    <message>
        <source>Faults found in the files: %1</source>
        <translation>In den Dateien gefundene Fehler: %1</translation>
    </message>
    <message>
        <source>%1: no samples</source>
        <translation>%1: keine Aufnahmen</translation>
    </message>
    <message>
        <source>%1, sample %2 of %3</source>
        <translation>%1, Aufnahme %2 von %3</translation>
    </message>
</context>
<context>
    <name>study::app::DebriefingPage</name>
    <message>
        <source>Comments of the participant about the session</source>
        <translation>Bemerkungen der Versuchsperson zum Versuch</translation>
    </message>
    <message>
        <source>After the last presentation</source>
        <translation>Nach der letzten Darbietung</translation>
    </message>
    <message>
        <source>The display is off. The participant may take off the mask now.</source>
        <translation>Das Display ist aus. Die Versuchsperson kann die Augenmaske jetzt abnehmen.</translation>
    </message>
    <message>
        <source>You may leave the field empty. The text is stored apart from the answers and can be erased later. Press Shift and Enter for a new line.</source>
        <translation>Sie können das Feld leer lassen. Der Text wird getrennt von den Antworten gespeichert und kann später gelöscht werden. Umschalt und Enter ergeben eine neue Zeile.</translation>
    </message>
    <message>
        <source>Finish the session (Enter)</source>
        <translation>Versuch abschließen (Enter)</translation>
    </message>
    <message>
        <source>Ask: “%1”</source>
        <translation>Fragen Sie: „%1“</translation>
    </message>
    <message>
        <source>Ask: “%1” Then explain the purpose of the study.</source>
        <translation>Fragen Sie: „%1“ Erklären Sie danach den Zweck der Studie.</translation>
    </message>
</context>
<context>
    <name>study::app::DisplayChoice</name>
    <message>
        <source>The display of the last time, %1, is not connected: an operator could open its plain images. Choose another display here, or start the program with --plain-images.</source>
        <translation>Das Display vom letzten Mal, %1, ist nicht verbunden: Die Versuchsleitung könnte seine Bilder öffnen. Wählen Sie hier ein anderes Display oder starten Sie das Programm mit --plain-images.</translation>
    </message>
    <message>
        <source>Connecting the display was stopped.</source>
        <translation>Das Verbinden des Displays wurde abgebrochen.</translation>
    </message>
</context>
<context>
    <name>study::app::DisplayPage</name>
    <message>
        <source>No display</source>
        <translation>Kein Display</translation>
    </message>
    <message>
        <source>Driver program</source>
        <translation>Treiberprogramm</translation>
    </message>
    <message>
        <source>Command that starts the driver</source>
        <translation>Befehl, der den Treiber startet</translation>
    </message>
    <message>
        <source>/opt/display/driver --port 3</source>
        <translation>/opt/display/driver --port 3</translation>
    </message>
    <message>
        <source>Driver on another computer</source>
        <translation>Treiber auf einem anderen Rechner</translation>
    </message>
    <message>
        <source>Host and port of the driver</source>
        <translation>Rechner und Port des Treibers</translation>
    </message>
    <message>
        <source>192.168.1.20:7000</source>
        <translation>192.168.1.20:7000</translation>
    </message>
    <message>
        <source>Cover of a touch screen, without a device</source>
        <translation>Abdeckung eines Touchscreens, ohne Gerät</translation>
    </message>
    <message>
        <source>Number of the screen, from 0</source>
        <translation>Nummer des Bildschirms, ab 0</translation>
    </message>
    <message>
        <source>1</source>
        <translation>1</translation>
    </message>
    <message>
        <source>Folder with plain images</source>
        <translation>Ordner mit unverschlüsselten Bildern</translation>
    </message>
    <message>
        <source>Folder that the device watches</source>
        <translation>Ordner, den das Gerät beobachtet</translation>
    </message>
    <message>
        <source>/run/display</source>
        <translation>/run/display</translation>
    </message>
    <message>
        <source>Address of the display</source>
        <translation>Adresse des Displays</translation>
    </message>
    <message>
        <source>Connect (Enter)</source>
        <translation>Verbinden (Enter)</translation>
    </message>
    <message>
        <source>Rehearse without a display</source>
        <translation>Probelauf ohne Display</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Width of one pixel, mm</source>
        <translation>Breite eines Pixels, mm</translation>
    </message>
    <message>
        <source>Kind of display</source>
        <translation>Art des Displays</translation>
    </message>
    <message>
        <source>Kinds of displays</source>
        <translation>Arten von Displays</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>Display</source>
        <translation>Display</translation>
    </message>
    <message>
        <source>Connect the haptic display and feel a test pattern before the participant comes.</source>
        <translation>Verbinden Sie das haptische Display und fühlen Sie ein Testmuster, bevor die Versuchsperson kommt.</translation>
    </message>
    <message>
        <source>Test patterns</source>
        <translation>Testmuster</translation>
    </message>
    <message>
        <source>Width of one pixel in mm. Gratings need it: divide the width of the active area by its number of pixels.</source>
        <translation>Breite eines Pixels in mm. Gitter brauchen sie: Teilen Sie die Breite der aktiven Fläche durch ihre Anzahl von Pixeln.</translation>
    </message>
    <message>
        <source>Connecting was stopped. The display is not connected.</source>
        <translation>Das Verbinden wurde abgebrochen. Das Display ist nicht verbunden.</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Connecting… The driver has up to 10 seconds to answer.</source>
        <translation>Das Display wird verbunden … Der Treiber hat bis zu 10 Sekunden Zeit zu antworten.</translation>
    </message>
    <message>
        <source>The display is connected. This window uses it from now on, and at the next start.</source>
        <translation>Das Display ist verbunden. Dieses Fenster benutzt es von jetzt an und beim nächsten Start.</translation>
    </message>
    <message>
        <source>Nothing can be felt without a display. A session with a participant needs one.</source>
        <translation>Ohne Display ist nichts zu fühlen. Ein Versuch mit einer Versuchsperson braucht eines.</translation>
    </message>
    <message>
        <source>Connected: %1</source>
        <translation>Verbunden: %1</translation>
    </message>
    <message>
        <source>Not connected</source>
        <translation>Nicht verbunden</translation>
    </message>
    <message>
        <source>%1 × %2 px</source>
        <translation>%1 × %2 px</translation>
    </message>
    <message>
        <source>sessions send %1 × %2 px: test the driver with `vis2hap display check`</source>
        <translation>Versuche senden %1 × %2 px: Prüfen Sie den Treiber mit `vis2hap display check`</translation>
    </message>
    <message>
        <source>reports touches (%1 so far)</source>
        <translation>meldet Berührungen (bisher %1)</translation>
    </message>
    <message>
        <source>takes its images from the server only: no test patterns</source>
        <translation>nimmt nur die Bilder des Servers an: keine Testmuster</translation>
    </message>
    <message>
        <source>does not report touches: press T at the first touch</source>
        <translation>meldet keine Berührungen: Drücken Sie T bei der ersten Berührung</translation>
    </message>
    <message>
        <source>On: %1</source>
        <translation>An: %1</translation>
    </message>
    <message>
        <source>Off: nothing can be felt</source>
        <translation>Aus: Es ist nichts zu fühlen</translation>
    </message>
</context>
<context>
    <name>study::app::EditorPage</name>
    <message>
        <source>Save (Ctrl S)</source>
        <translation>Speichern (Strg S)</translation>
    </message>
    <message>
        <source>Save as…</source>
        <translation>Speichern unter …</translation>
    </message>
    <message>
        <source>Make the study…</source>
        <translation>Studie anlegen …</translation>
    </message>
    <message>
        <source>Undo (Ctrl Z)</source>
        <translation>Rückgängig (Strg Z)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>This protocol belongs to a study that exists; `vis2hap study amend` changes it there. Here you edit a copy for a new study.</source>
        <translation>Dieses Protokoll gehört zu einer vorhandenen Studie; dort ändert es `vis2hap study amend`. Hier bearbeiten Sie eine Kopie für eine neue Studie.</translation>
    </message>
    <message>
        <source>The file has faults: %1. Each is shown with line and column.</source>
        <translation>Die Datei hat Fehler: %1. Jeder ist mit Zeile und Spalte gezeigt.</translation>
    </message>
    <message>
        <source>Save the protocol</source>
        <translation>Protokoll speichern</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>Protokolle (*.json)</translation>
    </message>
    <message>
        <source>This folder belongs to a study that exists. Save the protocol elsewhere; `vis2hap study amend` changes the protocol of that study.</source>
        <translation>Dieser Ordner gehört zu einer vorhandenen Studie. Speichern Sie das Protokoll anderswo; `vis2hap study amend` ändert das Protokoll jener Studie.</translation>
    </message>
    <message>
        <source>Saved: %1</source>
        <translation>Gespeichert: %1</translation>
    </message>
    <message>
        <source>Copy its recordings there, too: %1</source>
        <translation>Kopieren Sie auch seine Aufnahmen dorthin: %1</translation>
    </message>
    <message>
        <source>A study cannot follow this protocol yet. Mend the faults first: %1</source>
        <translation>Eine Studie kann diesem Protokoll noch nicht folgen. Beheben Sie zuerst die Fehler: %1</translation>
    </message>
    <message>
        <source>This page does not show that field. It is kept as it is in the file.</source>
        <translation>Diese Seite zeigt dieses Feld nicht. Es bleibt in der Datei, wie es ist.</translation>
    </message>
    <message>
        <source>This page cannot remove that key. Nothing was changed. Remove it in a text editor.</source>
        <translation>Diese Seite kann diesen Schlüssel nicht entfernen. Nichts wurde geändert. Entfernen Sie ihn in einem Texteditor.</translation>
    </message>
    <message>
        <source>New protocol</source>
        <translation>Neues Protokoll</translation>
    </message>
    <message>
        <source>%1 (not saved)</source>
        <translation>%1 (nicht gespeichert)</translation>
    </message>
    <message>
        <source>Back to the fields (F6)</source>
        <translation>Zurück zu den Feldern (F6)</translation>
    </message>
    <message>
        <source>%1. Details (F6)</source>
        <translation>%1. Einzelheiten (F6)</translation>
    </message>
</context>
<context>
    <name>study::app::EditorSections</name>
    <message>
        <source>empty: “%1”</source>
        <translation>leer: „%1“</translation>
    </message>
    <message>
        <source>Course of a session</source>
        <translation>Ablauf eines Versuchs</translation>
    </message>
    <message>
        <source>Empty fields have usual values, which they show.</source>
        <translation>Leere Felder haben übliche Werte, die sie zeigen.</translation>
    </message>
    <message>
        <source>Seconds a presentation</source>
        <translation>Sekunden je Darbietung</translation>
    </message>
    <message>
        <source>Presentations before a break</source>
        <translation>Darbietungen bis zur Pause</translation>
    </message>
    <message>
        <source>Minutes before a break</source>
        <translation>Minuten bis zur Pause</translation>
    </message>
    <message>
        <source>no limit</source>
        <translation>keine Grenze</translation>
    </message>
    <message>
        <source>Minutes of a sitting</source>
        <translation>Minuten einer Sitzung</translation>
    </message>
    <message>
        <source>Fabrics and tray</source>
        <translation>Stoffe und Tablett</translation>
    </message>
    <message>
        <source>Fabrics to get used to</source>
        <translation>Stoffe zur Eingewöhnung</translation>
    </message>
    <message>
        <source>Seconds a new tray is locked</source>
        <translation>Sekunden, die ein neues Tablett gesperrt ist</translation>
    </message>
    <message>
        <source>Codes on the fabric pieces</source>
        <translation>Codes auf den Stoffproben</translation>
    </message>
    <message>
        <source>one set for the whole study</source>
        <translation>ein Satz für die ganze Studie</translation>
    </message>
    <message>
        <source>new codes for each participant</source>
        <translation>neue Codes für jede Versuchsperson</translation>
    </message>
    <message>
        <source>The operator scans or types the code of every piece</source>
        <translation>Die Versuchsleitung scannt oder tippt den Code jeder Probe</translation>
    </message>
    <message>
        <source>The operator enters every answer twice</source>
        <translation>Die Versuchsleitung gibt jede Antwort zweimal ein</translation>
    </message>
    <message>
        <source>Texts</source>
        <translation>Texte</translation>
    </message>
    <message>
        <source>The operator reads them aloud or ticks them. Write them in the language of your participants.</source>
        <translation>Die Versuchsleitung liest sie vor oder hakt sie ab. Schreiben Sie sie in der Sprache Ihrer Versuchspersonen.</translation>
    </message>
    <message>
        <source>Language of the participants, as a tag</source>
        <translation>Sprache der Versuchspersonen, als Kürzel</translation>
    </message>
    <message>
        <source>en; others are de, pt-BR, zh-CN</source>
        <translation>en; andere sind de, pt-BR, zh-CN</translation>
    </message>
    <message>
        <source>Consent, which the operator confirms</source>
        <translation>Einwilligung, die die Versuchsleitung bestätigt</translation>
    </message>
    <message>
        <source>How to stroke glass and fabric</source>
        <translation>Wie über Glas und Stoff zu streichen ist</translation>
    </message>
    <message>
        <source>Checklist before a sitting, one point a line</source>
        <translation>Checkliste vor einer Sitzung, ein Punkt je Zeile</translation>
    </message>
    <message>
        <source>The participant wears the eye mask</source>
        <translation>Die Versuchsperson trägt die Augenmaske</translation>
    </message>
    <message>
        <source>Readings before a sitting, one quantity with its unit a line</source>
        <translation>Messwerte vor einer Sitzung, eine Größe mit Einheit je Zeile</translation>
    </message>
    <message>
        <source>temperature in °C</source>
        <translation>Temperatur in °C</translation>
    </message>
    <message>
        <source>Facts that the participant may give, one a line</source>
        <translation>Angaben, die die Versuchsperson machen kann, eine je Zeile</translation>
    </message>
    <message>
        <source>age</source>
        <translation>Alter</translation>
    </message>
    <message>
        <source>Participant&apos;s screen</source>
        <translation>Bildschirm der Versuchsperson</translation>
    </message>
    <message>
        <source>Choose a sentence and write your own. Names in braces, such as {time}, stay as they are.</source>
        <translation>Wählen Sie einen Satz und schreiben Sie einen eigenen. Namen in geschweiften Klammern wie {time} bleiben stehen.</translation>
    </message>
    <message>
        <source>Sentences by their names</source>
        <translation>Sätze mit ihren Namen</translation>
    </message>
    <message>
        <source>Your sentence; empty: the usual one</source>
        <translation>Ihr Satz; leer: der übliche</translation>
    </message>
    <message>
        <source>Recordings for the headphones</source>
        <translation>Aufnahmen für die Kopfhörer</translation>
    </message>
    <message>
        <source>WAV files that lie beside the protocol. A computer voice says what has no recording.</source>
        <translation>WAV-Dateien, die neben dem Protokoll liegen. Was keine Aufnahme hat, spricht eine Computerstimme.</translation>
    </message>
    <message>
        <source>Prompts by their names</source>
        <translation>Ansagen mit ihren Namen</translation>
    </message>
    <message>
        <source>File of the recording; empty: none</source>
        <translation>Datei der Aufnahme; leer: keine</translation>
    </message>
</context>
<context>
    <name>study::app::EditorStart</name>
    <message>
        <source>Floor and ceiling of ratings</source>
        <translation>Untere und obere Grenze der Bewertungen</translation>
    </message>
    <message>
        <source>Some images come with another fabric, some twice.</source>
        <translation>Manche Bilder kommen mit einem anderen Stoff, manche zweimal.</translation>
    </message>
    <message>
        <source>Two pieces and five words</source>
        <translation>Zwei Proben und fünf Wörter</translation>
    </message>
    <message>
        <source>One of two pieces, then how similar it is, in five words.</source>
        <translation>Eine von zwei Proben, dann mit fünf Wörtern, wie ähnlich sie ist.</translation>
    </message>
    <message>
        <source>Same or different</source>
        <translation>Gleich oder verschieden</translation>
    </message>
    <message>
        <source>Is the fabric the one on the screen? Blank glass finds guessers.</source>
        <translation>Ist der Stoff der auf dem Bildschirm? Leeres Glas findet, wer nur rät.</translation>
    </message>
    <message>
        <source>Speed against accuracy</source>
        <translation>Schnelligkeit gegen Genauigkeit</translation>
    </message>
    <message>
        <source>The same choices under “be fast”, “be accurate” and a deadline.</source>
        <translation>Dieselben Wahlen unter „schnell“, „genau“ und mit Zeitgrenze.</translation>
    </message>
    <message>
        <source>Quality of the rendering</source>
        <translation>Qualität des Renderns</translation>
    </message>
    <message>
        <source>One rendering at three prices in computing time.</source>
        <translation>Ein Verfahren mit drei verschiedenen Rechenzeiten.</translation>
    </message>
    <message>
        <source>Your own images</source>
        <translation>Ihre eigenen Bilder</translation>
    </message>
    <message>
        <source>Friction images that you made, beside two renderings of the program.</source>
        <translation>Reibungsbilder, die Sie gemacht haben, neben zwei Bedingungen dieses Programms.</translation>
    </message>
    <message>
        <source>Your own program</source>
        <translation>Ihr eigenes Programm</translation>
    </message>
    <message>
        <source>A program of yours makes the friction images, beside two renderings.</source>
        <translation>Ein Programm von Ihnen macht die Reibungsbilder, neben zwei Bedingungen.</translation>
    </message>
    <message>
        <source>Exercise for a class</source>
        <translation>Übung für einen Kurs</translation>
    </message>
    <message>
        <source>Simulated answers with planted effects and a careless participant.</source>
        <translation>Simulierte Antworten mit eingebauten Effekten und einer unachtsamen Versuchsperson.</translation>
    </message>
    <message>
        <source>Pilot of one participant</source>
        <translation>Vorversuch mit einer Versuchsperson</translation>
    </message>
    <message>
        <source>Shows whether the set-up works and how long a presentation takes.</source>
        <translation>Zeigt, ob der Aufbau funktioniert und wie lange eine Darbietung dauert.</translation>
    </message>
    <message>
        <source>%1
%2</source>
        <translation>%1
%2</translation>
    </message>
    <message>
        <source>Begin with this (Enter)</source>
        <translation>Hiermit beginnen (Enter)</translation>
    </message>
    <message>
        <source>Protocol file</source>
        <translation>Protokolldatei</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Open the protocol</source>
        <translation>Protokoll öffnen</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Make a protocol</source>
        <translation>Protokoll anlegen</translation>
    </message>
    <message>
        <source>A protocol says who feels what, in which order, and what is asked. A study that exists keeps its own; `vis2hap study amend` changes that.</source>
        <translation>Ein Protokoll sagt, wer was in welcher Reihenfolge fühlt und was gefragt wird. Eine vorhandene Studie behält ihres; `vis2hap study amend` ändert es.</translation>
    </message>
    <message>
        <source>Begin with</source>
        <translation>Beginnen mit</translation>
    </message>
    <message>
        <source>a protocol file to change, .json</source>
        <translation>eine Protokolldatei zum Ändern, .json</translation>
    </message>
    <message>
        <source>Change a protocol</source>
        <translation>Protokoll ändern</translation>
    </message>
    <message>
        <source>The study of the paper
10 participants, 7 fabrics, 9 conditions, a choice among three pieces and three ratings.</source>
        <translation>Die Studie des Artikels
10 Versuchspersonen, 7 Stoffe, 9 Bedingungen, eine Wahl unter drei Proben und drei Bewertungen.</translation>
    </message>
    <message>
        <source>Empty
Nothing is chosen yet.</source>
        <translation>Leer
Noch ist nichts gewählt.</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>Protokolle (*.json)</translation>
    </message>
    <message>
        <source>No file is given. Type a protocol file, or choose it with Browse.</source>
        <translation>Es ist keine Datei angegeben. Tippen Sie eine Protokolldatei oder wählen Sie sie mit „Durchsuchen“.</translation>
    </message>
</context>
<context>
    <name>study::app::FactsPage</name>
    <message>
        <source>Continue (Enter)</source>
        <translation>Fortfahren (Enter)</translation>
    </message>
    <message>
        <source>About the participant</source>
        <translation>Angaben zur Versuchsperson</translation>
    </message>
    <message>
        <source>Ask the participant and write the answers down. You may leave any line empty.</source>
        <translation>Fragen Sie die Versuchsperson und schreiben Sie die Antworten auf. Jede Zeile darf leer bleiben.</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>Sagen Sie: „%1“</translation>
    </message>
</context>
<context>
    <name>study::app::FamiliarisationPage</name>
    <message>
        <source>The participant is ready (Enter)</source>
        <translation>Die Versuchsperson ist bereit (Enter)</translation>
    </message>
    <message>
        <source>Getting to know the display</source>
        <translation>Das Display kennenlernen</translation>
    </message>
    <message>
        <source>Nothing is scored here. Seat the participant so that one hand reaches both the display and the tray.</source>
        <translation>Hier wird nichts gewertet. Setzen Sie die Versuchsperson so, dass eine Hand das Display und das Tablett erreicht.</translation>
    </message>
    <message>
        <source>Say: “%1”</source>
        <translation>Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Let the participant stroke some fabrics on the table, then the glass of the display.</source>
        <translation>Lassen Sie die Versuchsperson über einige Stoffe auf dem Tisch streichen, dann über das Glas des Displays.</translation>
    </message>
    <message>
        <source>Put one of these fabrics on the table and press its number: the display shows it. Let the participant stroke both as long as they like. Then take the next fabric.</source>
        <translation>Legen Sie einen dieser Stoffe auf den Tisch und drücken Sie seine Nummer: Das Display zeigt ihn. Lassen Sie die Versuchsperson über beide streichen, so lange sie möchte. Nehmen Sie dann den nächsten Stoff.</translation>
    </message>
    <message>
        <source>The display now shows %1.</source>
        <translation>Das Display zeigt jetzt %1.</translation>
    </message>
    <message>
        <source>The display shows nothing now.</source>
        <translation>Das Display zeigt jetzt nichts.</translation>
    </message>
</context>
<context>
    <name>study::app::FormPanel</name>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Store (Enter)</source>
        <translation>Speichern (Enter)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::GuidePage</name>
    <message>
        <source>Continue (Enter)</source>
        <translation>Fortfahren (Enter)</translation>
    </message>
    <message>
        <source>Skip the preparation (G)</source>
        <translation>Vorbereitung überspringen (G)</translation>
    </message>
    <message>
        <source>Break: %1:%2</source>
        <translation>Pause: %1:%2</translation>
    </message>
</context>
<context>
    <name>study::app::KeyedTexts</name>
    <message>
        <source>%1    own: %2</source>
        <translation>%1    eigener: %2</translation>
    </message>
</context>
<context>
    <name>study::app::KeysPage</name>
    <message>
        <source>Press another key… (Enter)</source>
        <translation>Andere Taste drücken … (Enter)</translation>
    </message>
    <message>
        <source>Remove the other key (Delete)</source>
        <translation>Andere Taste entfernen (Entf)</translation>
    </message>
    <message>
        <source>Remove all other keys</source>
        <translation>Alle anderen Tasten entfernen</translation>
    </message>
    <message>
        <source>Measure the latency of the operator…</source>
        <translation>Reaktionszeit der Versuchsleitung messen …</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Acts of a session and their keys</source>
        <translation>Handlungen eines Versuchs und ihre Tasten</translation>
    </message>
    <message>
        <source>Act</source>
        <translation>Handlung</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Taste</translation>
    </message>
    <message>
        <source>Other key</source>
        <translation>Andere Taste</translation>
    </message>
    <message>
        <source>Keys and pedals</source>
        <translation>Tasten und Pedale</translation>
    </message>
    <message>
        <source>A foot pedal is a keyboard with one key. Give its key to an act. The usual key acts as well.</source>
        <translation>Ein Fußpedal ist eine Tastatur mit einer Taste. Geben Sie seine Taste einer Handlung. Die übliche Taste gilt weiter.</translation>
    </message>
    <message>
        <source>Fixed keys: letters choose a piece, digits and the point enter a number, Tab moves between the controls, Page Up and Page Down scroll. A barcode scanner enters the codes of pieces on the page of the tray. The Enter of a scanner stores no answer.</source>
        <translation>Feste Tasten: Buchstaben wählen eine Probe, Ziffern und das Komma geben eine Zahl ein, Tab wechselt zwischen den Feldern, Bild auf und Bild ab verschieben die Seite. Ein Barcode-Leser gibt auf der Seite des Tabletts die Codes der Proben ein. Das Enter eines Lesers speichert keine Antwort.</translation>
    </message>
    <message>
        <source>Press the key or the pedal for “%1” now. Esc changes nothing.</source>
        <translation>Drücken Sie jetzt die Taste oder das Pedal für „%1“. Esc ändert nichts.</translation>
    </message>
    <message>
        <source>Nothing is changed.</source>
        <translation>Es wurde nichts geändert.</translation>
    </message>
    <message>
        <source>%1 now acts as “%2” in every session.</source>
        <translation>%1 steht jetzt in jedem Versuch für „%2“.</translation>
    </message>
    <message>
        <source> It does not scroll in a session any more.</source>
        <translation> Die Taste verschiebt in einem Versuch die Seite nicht mehr.</translation>
    </message>
    <message>
        <source>This act has no other key.</source>
        <translation>Diese Handlung hat keine andere Taste.</translation>
    </message>
    <message>
        <source>“%1” has only its usual key now.</source>
        <translation>„%1“ hat jetzt nur noch die übliche Taste.</translation>
    </message>
    <message>
        <source>Every act has only its usual key now.</source>
        <translation>Jede Handlung hat jetzt nur noch ihre übliche Taste.</translation>
    </message>
    <message>
        <source>–</source>
        <translation>–</translation>
    </message>
</context>
<context>
    <name>study::app::LatencyPage</name>
    <message>
        <source>Name of the operator</source>
        <translation>Name der Versuchsleitung</translation>
    </message>
    <message>
        <source>Begin with the bell (Enter)</source>
        <translation>Mit der Glocke beginnen (Enter)</translation>
    </message>
    <message>
        <source>Begin with a flash, without sound</source>
        <translation>Mit einem Blitz beginnen, ohne Ton</translation>
    </message>
    <message>
        <source>Ring the bell</source>
        <translation>Glocke läuten</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Latency of the operator</source>
        <translation>Reaktionszeit der Versuchsleitung</translation>
    </message>
    <message>
        <source>Press the space bar, or your pedal, at each signal for two minutes. The report shows your median beside the times that your keys stamp. It subtracts nothing.</source>
        <translation>Drücken Sie zwei Minuten lang bei jedem Signal die Leertaste oder Ihr Pedal. Der Bericht zeigt Ihren Median neben den Zeiten, die Ihre Tasten stempeln. Er zieht nichts ab.</translation>
    </message>
    <message>
        <source>The bell is that of this computer. Ring it first. If you hear nothing, use the flash: then the lamp below turns bright. Esc stops the task, and nothing is stored.</source>
        <translation>Die Glocke ist die dieses Rechners. Läuten Sie sie zuerst. Wenn Sie nichts hören, nehmen Sie den Blitz: Dann leuchtet die Lampe unten auf. Esc bricht die Aufgabe ab, und nichts wird gespeichert.</translation>
    </message>
    <message>
        <source>The name of the operator is missing. Type it, then begin.</source>
        <translation>Der Name der Versuchsleitung fehlt. Tippen Sie ihn und beginnen Sie dann.</translation>
    </message>
    <message>
        <source>%1 s left  ·  taps: %2</source>
        <translation>noch %1 s  ·  Tastendrücke: %2</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Wait</source>
        <translation>Warten</translation>
    </message>
    <message>
        <source>No signal was answered, so nothing is stored. Begin again.</source>
        <translation>Auf kein Signal kam eine Antwort; nichts wurde gespeichert. Beginnen Sie noch einmal.</translation>
    </message>
    <message>
        <source>Stored: median %1 ms, middle half from %2 to %3 ms, taps: %4, misses: %5, too early: %6.</source>
        <translation>Gespeichert: Median %1 ms, mittlere Hälfte von %2 bis %3 ms, Tastendrücke: %4, verpasst: %5, zu früh: %6.</translation>
    </message>
    <message>
        <source>The task was stopped. Nothing is stored.</source>
        <translation>Die Aufgabe wurde abgebrochen. Nichts wurde gespeichert.</translation>
    </message>
</context>
<context>
    <name>study::app::LeaveGuard</name>
    <message>
        <source>Save and leave</source>
        <translation>Speichern und verlassen</translation>
    </message>
    <message>
        <source>The protocol has changes that are not saved.</source>
        <translation>Das Protokoll hat Änderungen, die nicht gespeichert sind.</translation>
    </message>
    <message>
        <source>Leave without saving</source>
        <translation>Ohne Speichern verlassen</translation>
    </message>
    <message>
        <source>Stay (Esc)</source>
        <translation>Bleiben (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::LineProcess</name>
    <message>
        <source>the program ended</source>
        <translation>das Programm hat sich beendet</translation>
    </message>
</context>
<context>
    <name>study::app::MainWindow</name>
    <message>
        <source>Vis2Hap</source>
        <translation>Vis2Hap</translation>
    </message>
    <message>
        <source>%1 – Vis2Hap</source>
        <translation>%1 – Vis2Hap</translation>
    </message>
    <message>
        <source>No display is connected, so %1 would feel nothing. Connect a display, or rehearse without one.</source>
        <translation>Kein Display ist verbunden; %1 würde nichts fühlen. Verbinden Sie ein Display oder machen Sie einen Probelauf ohne Display.</translation>
    </message>
    <message>
        <source>%1 – %2 – Vis2Hap</source>
        <translation>%1 – %2 – Vis2Hap</translation>
    </message>
    <message>
        <source>Rehearsal – %1 – Vis2Hap</source>
        <translation>Probelauf – %1 – Vis2Hap</translation>
    </message>
</context>
<context>
    <name>study::app::MonitorWindow</name>
    <message>
        <source>just now</source>
        <translation>gerade eben</translation>
    </message>
    <message>
        <source>1 day ago</source>
        <translation>vor 1 Tag</translation>
    </message>
    <message>
        <source>%1 days ago</source>
        <translation>vor %1 Tagen</translation>
    </message>
    <message>
        <source>%1 min ago</source>
        <translation>vor %1 min</translation>
    </message>
    <message>
        <source>free</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>%1/%2</source>
        <translation>%1/%2</translation>
    </message>
    <message>
        <source>Stage of every participant</source>
        <translation>Stand jeder Versuchsperson</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Platz</translation>
    </message>
    <message>
        <source>Participant</source>
        <translation>Person</translation>
    </message>
    <message>
        <source>Stage</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>Presentation</source>
        <translation>Darbietung</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Antworten</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>Fehlend</translation>
    </message>
    <message>
        <source>Void</source>
        <translation>Ungültig</translation>
    </message>
    <message>
        <source>Last event</source>
        <translation>Zuletzt</translation>
    </message>
    <message>
        <source>This window only reads the study. It updates every two seconds.</source>
        <translation>Dieses Fenster liest die Studie nur. Es erneuert sich alle zwei Sekunden.</translation>
    </message>
    <message>
        <source>Missing: answers to voided presentations that have not been repeated yet.</source>
        <translation>Fehlend: Antworten zu ungültigen Darbietungen, die noch nicht wiederholt sind.</translation>
    </message>
    <message>
        <source>Close: Esc</source>
        <translation>Schließen: Esc</translation>
    </message>
    <message>
        <source>Flags</source>
        <translation>Auffälligkeiten</translation>
    </message>
    <message>
        <source>%1. The window tries again in two seconds.</source>
        <translation>%1. Das Fenster versucht es in zwei Sekunden noch einmal.</translation>
    </message>
    <message>
        <source>%1 – monitor – Vis2Hap</source>
        <translation>%1 – Beobachtung – Vis2Hap</translation>
    </message>
    <message>
        <source>%1 of %2 answers  ·  %3</source>
        <translation>%1 von %2 Antworten  ·  %3</translation>
    </message>
    <message>
        <source>blinded</source>
        <translation>verblindet</translation>
    </message>
    <message>
        <source>unblinded</source>
        <translation>entblindet</translation>
    </message>
    <message>
        <source>None so far.</source>
        <translation>Bisher keine.</translation>
    </message>
    <message>
        <source>%1 s ago</source>
        <translation>vor %1 s</translation>
    </message>
    <message>
        <source>connected</source>
        <translation>verbunden</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>%1 at that time</source>
        <translation>%1 zu dieser Zeit</translation>
    </message>
    <message>
        <source>Stations</source>
        <translation>Stationen</translation>
    </message>
    <message>
        <source>Station</source>
        <translation>Station</translation>
    </message>
    <message>
        <source>Connection</source>
        <translation>Verbindung</translation>
    </message>
    <message>
        <source>Last sign of life</source>
        <translation>Letztes Lebenszeichen</translation>
    </message>
    <message>
        <source>Entries that wait there</source>
        <translation>Dort wartende Einträge</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>Programm</translation>
    </message>
    <message>
        <source>none is connected</source>
        <translation>keine ist verbunden</translation>
    </message>
    <message>
        <source>Answers: %1</source>
        <translation>Antworten: %1</translation>
    </message>
    <message>
        <source>may wait</source>
        <translation>können warten</translation>
    </message>
</context>
<context>
    <name>study::app::NewStudyPage</name>
    <message>
        <source>Number of participants</source>
        <translation>Anzahl der Versuchspersonen</translation>
    </message>
    <message>
        <source>Seed of the running orders</source>
        <translation>Startwert der Abfolgen</translation>
    </message>
    <message>
        <source>Passphrase of the allocation key</source>
        <translation>Passphrase des Zuordnungsschlüssels</translation>
    </message>
    <message>
        <source>The same passphrase again</source>
        <translation>Noch einmal dieselbe Passphrase</translation>
    </message>
    <message>
        <source>Create the study (Enter)</source>
        <translation>Studie anlegen (Enter)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>New study</source>
        <translation>Neue Studie</translation>
    </message>
    <message>
        <source>No data set yet? Go back to “Data set from photographs”. To practise, `vis2hap fabrics make FOLDER` makes one. Sessions and progress reports need no passphrase. Means before the unblinding, and the unblinding itself, do. Nobody can restore a lost one.</source>
        <translation>Noch kein Datensatz? Gehen Sie zurück zu „Datensatz aus Fotos“. Zum Üben erzeugt `vis2hap fabrics make ORDNER` einen. Versuche und Berichte zum Stand brauchen keine Passphrase. Mittelwerte vor dem Entblinden und das Entblinden selbst brauchen sie. Niemand kann eine verlorene wiederherstellen.</translation>
    </message>
    <message>
        <source>empty: the number in the protocol</source>
        <translation>leer: die Anzahl im Protokoll</translation>
    </message>
    <message>
        <source>Language of the participants</source>
        <translation>Sprache der Versuchspersonen</translation>
    </message>
    <message>
        <source>Progress of creating the study</source>
        <translation>Fortschritt beim Anlegen der Studie</translation>
    </message>
    <message>
        <source>Study folder</source>
        <translation>Ordner der Studie</translation>
    </message>
    <message>
        <source>a folder that does not exist yet</source>
        <translation>ein Ordner, den es noch nicht gibt</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>Stoff-Datensatz</translation>
    </message>
    <message>
        <source>the folder that contains dataset.json</source>
        <translation>der Ordner, der dataset.json enthält</translation>
    </message>
    <message>
        <source>Protocol file</source>
        <translation>Protokolldatei</translation>
    </message>
    <message>
        <source>empty: the study of the paper</source>
        <translation>leer: die Studie des Artikels</translation>
    </message>
    <message>
        <source>Participants</source>
        <translation>Versuchspersonen</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startwert</translation>
    </message>
    <message>
        <source>Passphrase</source>
        <translation>Passphrase</translation>
    </message>
    <message>
        <source>Passphrase again</source>
        <translation>Passphrase noch einmal</translation>
    </message>
    <message>
        <source>8 characters or more; it seals which condition is shown when</source>
        <translation>8 Zeichen oder mehr; sie versiegelt, welche Bedingung wann gezeigt wird</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Browse for: %1</source>
        <translation>Durchsuchen für: %1</translation>
    </message>
    <message>
        <source>Protocols (*.json)</source>
        <translation>Protokolle (*.json)</translation>
    </message>
    <message>
        <source>Folder for the new study</source>
        <translation>Ordner für die neue Studie</translation>
    </message>
    <message>
        <source>No study folder is given. Type a folder that does not exist yet; the program creates it.</source>
        <translation>Es ist kein Ordner für die Studie angegeben. Tippen Sie einen Ordner, den es noch nicht gibt; das Programm legt ihn an.</translation>
    </message>
    <message>
        <source>No data set is given. Choose the fabric data set that the stimuli are made from.</source>
        <translation>Es ist kein Datensatz angegeben. Wählen Sie den Stoff-Datensatz, aus dem die Reize entstehen.</translation>
    </message>
    <message>
        <source>The seed is not valid. Type a whole number, 0 or larger.</source>
        <translation>Der Startwert ist ungültig. Tippen Sie eine ganze Zahl, 0 oder größer.</translation>
    </message>
    <message>
        <source>The passphrase holds only blanks. Type letters, digits and signs.</source>
        <translation>Die Passphrase besteht nur aus Leerzeichen. Tippen Sie Buchstaben, Ziffern und Zeichen.</translation>
    </message>
    <message>
        <source>The passphrase holds a character that nobody can type, such as a tab. Type it anew.</source>
        <translation>Die Passphrase enthält ein Zeichen, das niemand tippen kann, zum Beispiel einen Tabulator. Tippen Sie sie neu.</translation>
    </message>
    <message>
        <source>The passphrase is too short. Type 8 characters or more, such as four words.</source>
        <translation>Die Passphrase ist zu kurz. Tippen Sie 8 Zeichen oder mehr, zum Beispiel vier Wörter.</translation>
    </message>
    <message>
        <source>The two passphrases differ. Type the same one twice.</source>
        <translation>Die beiden Passphrasen sind verschieden. Tippen Sie zweimal dieselbe.</translation>
    </message>
    <message>
        <source>The number of participants is not valid. Type a whole number, 1 or larger, or leave the line empty.</source>
        <translation>Die Anzahl der Versuchspersonen ist ungültig. Tippen Sie eine ganze Zahl, 1 oder größer, oder lassen Sie die Zeile leer.</translation>
    </message>
    <message>
        <source>The program creates the study.</source>
        <translation>Das Programm legt die Studie an.</translation>
    </message>
    <message>
        <source>Cancel (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
    <message>
        <source>The program stops this work.</source>
        <translation>Das Programm bricht diese Arbeit ab.</translation>
    </message>
    <message>
        <source>Make or change a protocol…</source>
        <translation>Protokoll anlegen oder ändern …</translation>
    </message>
</context>
<context>
    <name>study::app::OpenStudy</name>
    <message>
        <source>%1. First close the study in this window (Esc).</source>
        <translation>%1. Schließen Sie zuerst die Studie in diesem Fenster (Esc).</translation>
    </message>
</context>
<context>
    <name>study::app::PagePreview</name>
    <message>
        <source>Page to preview</source>
        <translation>Seite der Vorschau</translation>
    </message>
    <message>
        <source>Question %1</source>
        <translation>Frage %1</translation>
    </message>
    <message>
        <source>Tray before a presentation</source>
        <translation>Tablett vor einer Darbietung</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: presentation</source>
        <translation>Bildschirm der Versuchsperson: Darbietung</translation>
    </message>
    <message>
        <source>Consent</source>
        <translation>Einwilligung</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: consent</source>
        <translation>Bildschirm der Versuchsperson: Einwilligung</translation>
    </message>
    <message>
        <source>Facts about the participant</source>
        <translation>Angaben zur Versuchsperson</translation>
    </message>
    <message>
        <source>Getting to know the display</source>
        <translation>Das Display kennenlernen</translation>
    </message>
    <message>
        <source>Learning the scale</source>
        <translation>Die Skala lernen</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: scale</source>
        <translation>Bildschirm der Versuchsperson: Skala</translation>
    </message>
    <message>
        <source>Checklist of a sitting</source>
        <translation>Checkliste einer Sitzung</translation>
    </message>
    <message>
        <source>Break</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: break</source>
        <translation>Bildschirm der Versuchsperson: Pause</translation>
    </message>
    <message>
        <source>Preview: %1</source>
        <translation>Vorschau: %1</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: waiting</source>
        <translation>Bildschirm der Versuchsperson: Warten</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: welcome</source>
        <translation>Bildschirm der Versuchsperson: Begrüßung</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: facts</source>
        <translation>Bildschirm der Versuchsperson: Angaben</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: getting to know the display</source>
        <translation>Bildschirm der Versuchsperson: Display kennenlernen</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: blindfold</source>
        <translation>Bildschirm der Versuchsperson: Augenmaske</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: last questions</source>
        <translation>Bildschirm der Versuchsperson: letzte Fragen</translation>
    </message>
    <message>
        <source>Participant&apos;s screen: end</source>
        <translation>Bildschirm der Versuchsperson: Ende</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantPage</name>
    <message>
        <source>Show on this screen (Enter)</source>
        <translation>Auf diesem Bildschirm zeigen (Enter)</translation>
    </message>
    <message>
        <source>Start the page</source>
        <translation>Seite starten</translation>
    </message>
    <message>
        <source>Draw a new code</source>
        <translation>Neuen Code ziehen</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Start the sound</source>
        <translation>Ton starten</translation>
    </message>
    <message>
        <source>Play a prompt</source>
        <translation>Ansage abspielen</translation>
    </message>
    <message>
        <source>Screen of the participant</source>
        <translation>Bildschirm der Versuchsperson</translation>
    </message>
    <message>
        <source>Screens</source>
        <translation>Bildschirme</translation>
    </message>
    <message>
        <source>Network of the page</source>
        <translation>Netz der Seite</translation>
    </message>
    <message>
        <source>Networks</source>
        <translation>Netze</translation>
    </message>
    <message>
        <source>Masking noise</source>
        <translation>Maskierungsrauschen</translation>
    </message>
    <message>
        <source>Levels of the masking noise</source>
        <translation>Lautstärken des Maskierungsrauschens</translation>
    </message>
    <message>
        <source>No noise</source>
        <translation>Kein Rauschen</translation>
    </message>
    <message>
        <source>Quiet noise</source>
        <translation>Leises Rauschen</translation>
    </message>
    <message>
        <source>Medium noise</source>
        <translation>Mittleres Rauschen</translation>
    </message>
    <message>
        <source>Loud noise</source>
        <translation>Lautes Rauschen</translation>
    </message>
    <message>
        <source>Prompts without a recording</source>
        <translation>Ansagen ohne Aufnahme</translation>
    </message>
    <message>
        <source>A computer voice speaks prompts without a recording</source>
        <translation>Eine Computerstimme spricht Ansagen ohne Aufnahme</translation>
    </message>
    <message>
        <source>The operator speaks prompts without a recording</source>
        <translation>Die Versuchsleitung spricht Ansagen ohne Aufnahme</translation>
    </message>
    <message>
        <source>Participant&apos;s screen</source>
        <translation>Bildschirm der Versuchsperson</translation>
    </message>
    <message>
        <source>Shows the participant what to do: consent, questions, the scale, breaks. It shows no code, fabric or condition. The session works without it at any moment.</source>
        <translation>Zeigt der Versuchsperson, was zu tun ist: Einwilligung, Fragen, Skala, Pausen. Er zeigt keinen Code, keinen Stoff und keine Bedingung. Der Versuch läuft jederzeit auch ohne ihn.</translation>
    </message>
    <message>
        <source>Second screen of this computer</source>
        <translation>Zweiter Bildschirm dieses Rechners</translation>
    </message>
    <message>
        <source>Tablet in the same room</source>
        <translation>Tablet im selben Raum</translation>
    </message>
    <message>
        <source>The tablet&apos;s browser opens the address and enters the code. The connection is plain HTTP: everybody in the chosen network can read it. Choose a network of your own.</source>
        <translation>Der Browser des Tablets öffnet die Adresse und gibt den Code ein. Die Verbindung ist einfaches HTTP: Alle im gewählten Netz können sie mitlesen. Wählen Sie ein eigenes Netz.</translation>
    </message>
    <message>
        <source>Headphones</source>
        <translation>Kopfhörer</translation>
    </message>
    <message>
        <source>Screen %1%2, %3 × %4</source>
        <translation>Bildschirm %1%2, %3 × %4</translation>
    </message>
    <message>
        <source>%1 (this one)</source>
        <translation>%1 (dieser)</translation>
    </message>
    <message>
        <source>This computer only: 127.0.0.1</source>
        <translation>Nur dieser Rechner: 127.0.0.1</translation>
    </message>
    <message>
        <source>%1: %2 (readable in this network)</source>
        <translation>%1: %2 (in diesem Netz lesbar)</translation>
    </message>
    <message>
        <source>This screen is not connected any more. Choose another one.</source>
        <translation>Dieser Bildschirm ist nicht mehr angeschlossen. Wählen Sie einen anderen.</translation>
    </message>
    <message>
        <source>The study names no recordings.</source>
        <translation>Die Studie nennt keine Aufnahmen.</translation>
    </message>
    <message>
        <source>Recordings of the study: %1.</source>
        <translation>Aufnahmen der Studie: %1.</translation>
    </message>
    <message>
        <source>%1 The voice %2 speaks the other prompts.</source>
        <translation>%1 Die Stimme %2 spricht die übrigen Ansagen.</translation>
    </message>
    <message>
        <source>%1 The operator speaks the other prompts.</source>
        <translation>%1 Die Versuchsleitung spricht die übrigen Ansagen.</translation>
    </message>
    <message>
        <source>Stop the sound</source>
        <translation>Ton beenden</translation>
    </message>
    <message>
        <source>Playing on %1. %2</source>
        <translation>Wiedergabe auf %1. %2</translation>
    </message>
    <message>
        <source>Close the window (Enter)</source>
        <translation>Fenster schließen (Enter)</translation>
    </message>
    <message>
        <source>The participant&apos;s window is open.</source>
        <translation>Das Fenster der Versuchsperson ist offen.</translation>
    </message>
    <message>
        <source>Stop the page</source>
        <translation>Seite beenden</translation>
    </message>
    <message>
        <source>Code: %1</source>
        <translation>Code: %1</translation>
    </message>
    <message>
        <source>A browser at %1 shows the page. To use another one, draw a new code.</source>
        <translation>Ein Browser auf %1 zeigt die Seite. Um einen anderen zu benutzen, ziehen Sie einen neuen Code.</translation>
    </message>
    <message>
        <source> Another browser at %1 was refused.</source>
        <translation> Ein anderer Browser auf %1 wurde abgewiesen.</translation>
    </message>
    <message>
        <source>The code is void after %1 wrong tries. Draw a new code.</source>
        <translation>Der Code gilt nach %1 falschen Versuchen nicht mehr. Ziehen Sie einen neuen Code.</translation>
    </message>
    <message>
        <source>No browser has entered the code yet.</source>
        <translation>Noch kein Browser hat den Code eingegeben.</translation>
    </message>
    <message>
        <source>No browser has entered the code yet. Wrong codes: %1</source>
        <translation>Noch kein Browser hat den Code eingegeben. Falsche Codes: %1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantSide</name>
    <message>
        <source>The participant&apos;s page has stopped: %1</source>
        <translation>Die Seite der Versuchsperson wurde beendet: %1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantSound</name>
    <message>
        <source>The headphones do not read %1 back, because they have nothing for “%2”. Read it back yourself</source>
        <translation>Der Kopfhörer liest %1 nicht vor, weil ihm „%2“ fehlt. Lesen Sie es selbst vor</translation>
    </message>
    <message>
        <source>The sound has stopped: %1</source>
        <translation>Der Ton wurde beendet: %1</translation>
    </message>
</context>
<context>
    <name>study::app::ParticipantWindow</name>
    <message>
        <source>For the participant – Vis2Hap</source>
        <translation>Für die Versuchsperson – Vis2Hap</translation>
    </message>
</context>
<context>
    <name>study::app::PhaseDetail</name>
    <message>
        <source>Phase %1</source>
        <translation>Phase %1</translation>
    </message>
    <message>
        <source>Answers of phase %1</source>
        <translation>Antworten von Phase %1</translation>
    </message>
    <message>
        <source>The participant answers</source>
        <translation>Die Versuchsperson antwortet</translation>
    </message>
    <message>
        <source>Pieces on the tray</source>
        <translation>Proben auf dem Tablett</translation>
    </message>
    <message>
        <source>Presentations of blank glass</source>
        <translation>Darbietungen von leerem Glas</translation>
    </message>
    <message>
        <source>Anchors with another fabric</source>
        <translation>Anker mit einem anderen Stoff</translation>
    </message>
    <message>
        <source>Anchors felt twice</source>
        <translation>Doppelt gefühlte Anker</translation>
    </message>
    <message>
        <source>Leave as many pieces as possible on the tray from one to the next</source>
        <translation>Von einer Darbietung zur nächsten möglichst viele Proben auf dem Tablett lassen</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Bis</translation>
    </message>
    <message>
        <source>In steps of</source>
        <translation>In Schritten von</translation>
    </message>
    <message>
        <source>Equal parts of the line</source>
        <translation>Gleiche Abschnitte der Linie</translation>
    </message>
    <message>
        <source>Words of the scale, one a line, the lowest first</source>
        <translation>Wörter der Skala, eines je Zeile, das niedrigste zuerst</translation>
    </message>
    <message>
        <source>Questions of this phase</source>
        <translation>Fragen dieser Phase</translation>
    </message>
    <message>
        <source>A short name for tables, such as Soft, and the sentence that the operator says.</source>
        <translation>Ein kurzer Name für Tabellen, zum Beispiel Weich, und der Satz, den die Versuchsleitung sagt.</translation>
    </message>
    <message>
        <source>%1 more questions are kept and not shown.</source>
        <translation>%1 weitere Fragen bleiben erhalten und sind nicht gezeigt.</translation>
    </message>
    <message>
        <source>Add a question</source>
        <translation>Frage hinzufügen</translation>
    </message>
    <message>
        <source>Questions of phase %1</source>
        <translation>Fragen von Phase %1</translation>
    </message>
    <message>
        <source>Name of question %1</source>
        <translation>Name der Frage %1</translation>
    </message>
    <message>
        <source>Question %1 of phase %2</source>
        <translation>Frage %1 von Phase %2</translation>
    </message>
    <message>
        <source>Sentence of question %1</source>
        <translation>Satz der Frage %1</translation>
    </message>
    <message>
        <source>How soft does the screen feel, compared with the fabric?</source>
        <translation>Wie weich fühlt sich der Bildschirm an, verglichen mit dem Stoff?</translation>
    </message>
    <message>
        <source>Sentence of question %1 of phase %2</source>
        <translation>Satz der Frage %1 von Phase %2</translation>
    </message>
    <message>
        <source>Question %1 is answered in own words</source>
        <translation>Frage %1 wird in eigenen Worten beantwortet</translation>
    </message>
    <message>
        <source>answered in own words</source>
        <translation>in eigenen Worten beantwortet</translation>
    </message>
    <message>
        <source>Remove question %1</source>
        <translation>Frage %1 entfernen</translation>
    </message>
    <message>
        <source>Speed or accuracy</source>
        <translation>Schnelligkeit oder Genauigkeit</translation>
    </message>
    <message>
        <source>Without instructions the phase runs once. With them it runs once under each, in balanced orders.</source>
        <translation>Ohne Anweisungen läuft die Phase einmal. Mit ihnen läuft sie unter jeder einmal, in ausgewogenen Abfolgen.</translation>
    </message>
    <message>
        <source>Add an instruction</source>
        <translation>Anweisung hinzufügen</translation>
    </message>
    <message>
        <source>Instructions of phase %1</source>
        <translation>Anweisungen von Phase %1</translation>
    </message>
    <message>
        <source>Name of instruction %1</source>
        <translation>Name der Anweisung %1</translation>
    </message>
    <message>
        <source>Aim of instruction %1</source>
        <translation>Ziel der Anweisung %1</translation>
    </message>
    <message>
        <source>neither</source>
        <translation>keines von beiden</translation>
    </message>
    <message>
        <source>be fast</source>
        <translation>schnell</translation>
    </message>
    <message>
        <source>be accurate</source>
        <translation>genau</translation>
    </message>
    <message>
        <source>Aim</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Seconds for an answer</source>
        <translation>Sekunden für eine Antwort</translation>
    </message>
    <message>
        <source>no limit</source>
        <translation>keine Grenze</translation>
    </message>
    <message>
        <source>Remove instruction %1</source>
        <translation>Anweisung %1 entfernen</translation>
    </message>
    <message>
        <source>What the operator says</source>
        <translation>Was die Versuchsleitung sagt</translation>
    </message>
    <message>
        <source>empty: the usual sentence</source>
        <translation>leer: der übliche Satz</translation>
    </message>
</context>
<context>
    <name>study::app::PhasesSection</name>
    <message>
        <source>Kind of a new phase</source>
        <translation>Art einer neuen Phase</translation>
    </message>
    <message>
        <source>Add a phase</source>
        <translation>Phase hinzufügen</translation>
    </message>
    <message>
        <source>Move up</source>
        <translation>Nach oben</translation>
    </message>
    <message>
        <source>Move down</source>
        <translation>Nach unten</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Questions</source>
        <translation>Fragen</translation>
    </message>
    <message>
        <source>In a phase, every fabric is felt under every condition once. Its questions follow one another. Phases follow in this order.</source>
        <translation>In einer Phase wird jeder Stoff unter jeder Bedingung einmal gefühlt. Ihre Fragen folgen aufeinander. Die Phasen folgen in dieser Reihenfolge.</translation>
    </message>
    <message>
        <source>Phases in their order</source>
        <translation>Phasen in ihrer Reihenfolge</translation>
    </message>
    <message>
        <source>Phases</source>
        <translation>Phasen</translation>
    </message>
    <message>
        <source>%1    %2: %3</source>
        <translation>%1    %2: %3</translation>
    </message>
    <message>
        <source>choose the fabric among pieces</source>
        <translation>den Stoff unter Proben wählen</translation>
    </message>
    <message>
        <source>rate with numbers</source>
        <translation>mit Zahlen bewerten</translation>
    </message>
    <message>
        <source>rate with words</source>
        <translation>mit Wörtern bewerten</translation>
    </message>
    <message>
        <source>same or different</source>
        <translation>gleich oder verschieden</translation>
    </message>
    <message>
        <source>own words</source>
        <translation>eigene Worte</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographForm</name>
    <message>
        <source>Grey photograph</source>
        <translation>Grauwerte des Fotos</translation>
    </message>
    <message>
        <source>Shape from shading</source>
        <translation>Form aus der Schattierung</translation>
    </message>
    <message>
        <source>Generated height</source>
        <translation>Erzeugte Höhe</translation>
    </message>
    <message>
        <source>Generated friction</source>
        <translation>Erzeugte Reibung</translation>
    </message>
    <message>
        <source>Generated height and friction</source>
        <translation>Erzeugte Höhe und Reibung</translation>
    </message>
    <message>
        <source>Photograph or folder</source>
        <translation>Foto oder Ordner</translation>
    </message>
    <message>
        <source>Browse files…</source>
        <translation>Dateien suchen …</translation>
    </message>
    <message>
        <source>Browse folders…</source>
        <translation>Ordner suchen …</translation>
    </message>
    <message>
        <source>Add (Enter)</source>
        <translation>Hinzufügen (Enter)</translation>
    </message>
    <message>
        <source>Check the photographs</source>
        <translation>Fotos prüfen</translation>
    </message>
    <message>
        <source>Folder of the new data set</source>
        <translation>Ordner des neuen Datensatzes</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Write the data set</source>
        <translation>Datensatz schreiben</translation>
    </message>
    <message>
        <source>Render</source>
        <translation>Rechnen</translation>
    </message>
    <message>
        <source>Go on to the new study</source>
        <translation>Weiter zur neuen Studie</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Data set from photographs</source>
        <translation>Datensatz aus Fotos</translation>
    </message>
    <message>
        <source>1  Photographs</source>
        <translation>1  Fotos</translation>
    </message>
    <message>
        <source>Take all pictures with one camera, from straight above, at the same distance. Lay a ruler into one of them.</source>
        <translation>Nehmen Sie alle Bilder mit einer Kamera auf, senkrecht von oben, aus gleichem Abstand. Legen Sie in eines ein Lineal.</translation>
    </message>
    <message>
        <source>an image file, or a folder with images</source>
        <translation>eine Bilddatei oder ein Ordner mit Bildern</translation>
    </message>
    <message>
        <source>2  Scale</source>
        <translation>2  Maßstab</translation>
    </message>
    <message>
        <source>One scale holds for all photographs. Give one of the three lengths, or leave them if you do not know it.</source>
        <translation>Ein Maßstab gilt für alle Fotos. Geben Sie eine der drei Längen an, oder keine, wenn Sie sie nicht kennen.</translation>
    </message>
    <message>
        <source>Warnings about the photographs</source>
        <translation>Warnungen zu den Fotos</translation>
    </message>
    <message>
        <source>3  Check</source>
        <translation>3  Prüfung</translation>
    </message>
    <message>
        <source>Does each photograph resemble those that the networks learned from? Otherwise height and friction are guesses.</source>
        <translation>Gleicht jedes Foto denen, aus denen die Netze gelernt haben? Sonst sind Höhe und Reibung nur geraten.</translation>
    </message>
    <message>
        <source>4  Data set</source>
        <translation>4  Datensatz</translation>
    </message>
    <message>
        <source>The program makes this folder. Nothing that exists is overwritten.</source>
        <translation>Das Programm legt diesen Ordner an. Nichts Vorhandenes wird überschrieben.</translation>
    </message>
    <message>
        <source>a folder that does not exist yet</source>
        <translation>ein Ordner, den es noch nicht gibt</translation>
    </message>
    <message>
        <source>5  Conditions and friction images</source>
        <translation>5  Bedingungen und Reibungsbilder</translation>
    </message>
    <message>
        <source>Choose the conditions. If you wish, look at the images that participants will feel: bright means high friction.</source>
        <translation>Wählen Sie die Bedingungen. Wenn Sie möchten, sehen Sie die Bilder an, die Versuchspersonen fühlen werden: Hell bedeutet hohe Reibung.</translation>
    </message>
    <message>
        <source>6  Study</source>
        <translation>6  Studie</translation>
    </message>
    <message>
        <source>The program writes a protocol beside the data set: the questions of the paper under the chosen conditions. You may edit it.</source>
        <translation>Das Programm schreibt ein Protokoll neben den Datensatz: die Fragen des Artikels unter den gewählten Bedingungen. Sie können es bearbeiten.</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographList</name>
    <message>
        <source>Each file is a fabric</source>
        <translation>Jede Datei ist ein Stoff</translation>
    </message>
    <message>
        <source>Each folder is a fabric</source>
        <translation>Jeder Ordner ist ein Stoff</translation>
    </message>
    <message>
        <source>Name of the fabric</source>
        <translation>Name des Stoffs</translation>
    </message>
    <message>
        <source>Remove the photograph (Del)</source>
        <translation>Foto entfernen (Entf)</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotos</translation>
    </message>
    <message>
        <source>Fabric</source>
        <translation>Stoff</translation>
    </message>
    <message>
        <source>Photograph</source>
        <translation>Foto</translation>
    </message>
    <message>
        <source>Size, px</source>
        <translation>Größe, px</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Name of the chosen fabric (Enter: the next one)</source>
        <translation>Name des gewählten Stoffs (Enter: der nächste)</translation>
    </message>
    <message>
        <source>%1 × %2</source>
        <translation>%1 × %2</translation>
    </message>
    <message>
        <source>%1 %2, %3 %4</source>
        <translation>%1 %2, %3 %4</translation>
    </message>
    <message>
        <source>photograph</source>
        <translation>Foto</translation>
    </message>
    <message>
        <source>photographs</source>
        <translation>Fotos</translation>
    </message>
    <message>
        <source>fabric</source>
        <translation>Stoff</translation>
    </message>
    <message>
        <source>fabrics</source>
        <translation>Stoffe</translation>
    </message>
    <message>
        <source>This fabric has no name. Type a name, such as the one on its label.</source>
        <translation>Dieser Stoff hat keinen Namen. Tippen Sie einen, zum Beispiel den auf seinem Etikett.</translation>
    </message>
    <message>
        <source>The name &quot;%1&quot; %2. A name has %3.</source>
        <translation>Der Name „%1“ %2. Ein Name hat %3.</translation>
    </message>
    <message>
        <source>Two fabrics have the name &quot;%1&quot;. Give one of them another name.</source>
        <translation>Zwei Stoffe haben den Namen „%1“. Geben Sie einem von ihnen einen anderen.</translation>
    </message>
    <message>
        <source>no warning</source>
        <translation>keine Warnung</translation>
    </message>
    <message>
        <source>1 warning</source>
        <translation>1 Warnung</translation>
    </message>
    <message>
        <source>%1 warnings</source>
        <translation>%1 Warnungen</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographRuler</name>
    <message>
        <source>Ruler on the photograph</source>
        <translation>Lineal auf dem Foto</translation>
    </message>
    <message>
        <source>No point is marked.</source>
        <translation>Kein Punkt ist gesetzt.</translation>
    </message>
    <message>
        <source>One point is marked.</source>
        <translation>Ein Punkt ist gesetzt.</translation>
    </message>
    <message>
        <source>Two points are marked, %1 px apart.</source>
        <translation>Zwei Punkte sind gesetzt, %1 px voneinander entfernt.</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographScale</name>
    <message>
        <source>Width of one pixel, mm</source>
        <translation>Breite eines Pixels, mm</translation>
    </message>
    <message>
        <source>Width of the photograph, mm</source>
        <translation>Breite des Fotos, mm</translation>
    </message>
    <message>
        <source>Distance of the two points, mm</source>
        <translation>Abstand der beiden Punkte, mm</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>nicht gemessen</translation>
    </message>
    <message>
        <source>or the width of the whole photograph, mm</source>
        <translation>oder die Breite des ganzen Fotos, mm</translation>
    </message>
    <message>
        <source>or mark two points on the picture; their distance, mm</source>
        <translation>oder setzen Sie zwei Punkte auf dem Bild; ihr Abstand, mm</translation>
    </message>
    <message>
        <source>Click two points. By keys: arrows move the cross (Shift: in small steps), Space sets a point.</source>
        <translation>Klicken Sie zwei Punkte an. Mit Tasten: Pfeile bewegen das Kreuz (Umschalt: in kleinen Schritten), die Leertaste setzt einen Punkt.</translation>
    </message>
    <message>
        <source>This is not a number. Type millimetres, such as 0.05 or 120.</source>
        <translation>Das ist keine Zahl. Tippen Sie Millimeter, zum Beispiel 0,05 oder 120.</translation>
    </message>
    <message>
        <source>This length is not larger than 0. Type millimetres, such as 0.05 or 120.</source>
        <translation>Diese Länge ist nicht größer als 0. Tippen Sie Millimeter, zum Beispiel 0,05 oder 120.</translation>
    </message>
    <message>
        <source>The two points are at the same place. Mark points that lie far apart.</source>
        <translation>Die beiden Punkte liegen an derselben Stelle. Setzen Sie Punkte, die weit auseinanderliegen.</translation>
    </message>
    <message>
        <source>One pixel would be %1 mm wide (expected %2 to %3 mm). Check the number and its unit.</source>
        <translation>Ein Pixel wäre %1 mm breit (erwartet %2 bis %3 mm). Prüfen Sie die Zahl und ihre Einheit.</translation>
    </message>
    <message>
        <source>The picture shows %1 × %2 mm of fabric.</source>
        <translation>Das Bild zeigt %1 × %2 mm Stoff.</translation>
    </message>
    <message>
        <source>The scale is not known. The program then assumes an ordinary weave.</source>
        <translation>Der Maßstab ist nicht bekannt. Das Programm nimmt dann ein gewöhnliches Gewebe an.</translation>
    </message>
</context>
<context>
    <name>study::app::PhotographsPage</name>
    <message>
        <source>%1 more files were refused.</source>
        <translation>%1 weitere Dateien wurden abgelehnt.</translation>
    </message>
    <message>
        <source>Photographs</source>
        <translation>Fotos</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff);;All files (*)</source>
        <translation>Bilder (*.png *.jpg *.jpeg *.bmp *.tif *.tiff);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Folder of photographs</source>
        <translation>Ordner mit Fotos</translation>
    </message>
    <message>
        <source>Folder that receives the data set</source>
        <translation>Ordner, der den Datensatz aufnimmt</translation>
    </message>
    <message>
        <source>No photograph is given. Type a file or folder, or choose it with Browse.</source>
        <translation>Es ist kein Foto angegeben. Tippen Sie eine Datei oder einen Ordner, oder wählen Sie mit „Durchsuchen“.</translation>
    </message>
    <message>
        <source>The program reads the photographs. Esc stops it.</source>
        <translation>Das Programm liest die Fotos. Esc bricht ab.</translation>
    </message>
    <message>
        <source>The program compares the photographs with those it knows.</source>
        <translation>Das Programm vergleicht die Fotos mit denen, die es kennt.</translation>
    </message>
    <message>
        <source>No warnings. The photographs resemble those that the networks learned from.</source>
        <translation>Keine Warnungen. Die Fotos gleichen denen, aus denen die Netze gelernt haben.</translation>
    </message>
    <message>
        <source>%1 of %2 photographs have warnings. You may go on, or take them again.</source>
        <translation>%1 von %2 Fotos haben Warnungen. Sie können weitermachen oder sie neu aufnehmen.</translation>
    </message>
    <message>
        <source>No folder is given. Type a folder that does not exist yet.</source>
        <translation>Es ist kein Ordner angegeben. Tippen Sie einen Ordner, den es noch nicht gibt.</translation>
    </message>
    <message>
        <source>The program writes the data set.</source>
        <translation>Das Programm schreibt den Datensatz.</translation>
    </message>
    <message>
        <source>Written: %1 (fabrics: %2, photographs: %3)</source>
        <translation>Geschrieben: %1 (Stoffe: %2, Fotos: %3)</translation>
    </message>
    <message>
        <source>No condition is chosen. Choose one or more of the five.</source>
        <translation>Keine Bedingung ist gewählt. Wählen Sie eine oder mehrere der fünf.</translation>
    </message>
    <message>
        <source>The program writes the protocol.</source>
        <translation>Das Programm schreibt das Protokoll.</translation>
    </message>
    <message>
        <source>The program renders the friction images. This can take minutes.</source>
        <translation>Das Programm rechnet die Reibungsbilder. Das kann Minuten dauern.</translation>
    </message>
    <message>
        <source>Friction images: %1</source>
        <translation>Reibungsbilder: %1</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
</context>
<context>
    <name>study::app::QuestionHead</name>
    <message>
        <source>Instruction of this block: “%1”</source>
        <translation>Anweisung für diesen Block: „%1“</translation>
    </message>
    <message>
        <source>Read this aloud now: “%1”</source>
        <translation>Lesen Sie das jetzt vor: „%1“</translation>
    </message>
    <message>
        <source>Before you continue, say what the next block asks for: “%1”</source>
        <translation>Sagen Sie vor dem Fortfahren, worum es im nächsten Block geht: „%1“</translation>
    </message>
    <message>
        <source>Presentation %1    ·    %2    ·    say:</source>
        <translation>Darbietung %1    ·    %2    ·    Sagen Sie:</translation>
    </message>
    <message>
        <source>“%1”</source>
        <translation>„%1“</translation>
    </message>
</context>
<context>
    <name>study::app::QuestionPage</name>
    <message>
        <source>The answer begins (F9)</source>
        <translation>Die Antwort beginnt (F9)</translation>
    </message>
    <message>
        <source>Store the answer (Enter)</source>
        <translation>Antwort speichern (Enter)</translation>
    </message>
    <message>
        <source>Next tray: %1</source>
        <translation>Nächstes Tablett: %1</translation>
    </message>
    <message>
        <source>The answer begins</source>
        <translation>Die Antwort beginnt</translation>
    </message>
    <message>
        <source>The beginning is stamped ✓</source>
        <translation>Der Beginn ist gestempelt ✓</translation>
    </message>
    <message>
        <source>Go to the second entry</source>
        <translation>Zur zweiten Eingabe</translation>
    </message>
    <message>
        <source>Store the answer</source>
        <translation>Antwort speichern</translation>
    </message>
    <message>
        <source>Second entry.</source>
        <translation>Zweite Eingabe.</translation>
    </message>
    <message>
        <source>Press Enter, then enter the same answer again.</source>
        <translation>Drücken Sie Enter und geben Sie dann dieselbe Antwort noch einmal ein.</translation>
    </message>
    <message>
        <source>Press Enter to store it.</source>
        <translation>Drücken Sie Enter, um sie zu speichern.</translation>
    </message>
</context>
<context>
    <name>study::app::RatingControls</name>
    <message>
        <source>Rating that the participant says</source>
        <translation>Bewertung, die die Versuchsperson sagt</translation>
    </message>
    <message>
        <source>Read back: “%1.”</source>
        <translation>Lesen Sie vor: „%1.“</translation>
    </message>
    <message>
        <source>Type the number that the participant says, or click on the line.</source>
        <translation>Tippen Sie die Zahl, die die Versuchsperson sagt, oder klicken Sie auf die Linie.</translation>
    </message>
</context>
<context>
    <name>study::app::ReasonPanel</name>
    <message>
        <source>Code of the participant</source>
        <translation>Code der Versuchsperson</translation>
    </message>
    <message>
        <source>Participant&apos;s code</source>
        <translation>Code der Versuchsperson</translation>
    </message>
    <message>
        <source>This ends the session for good. Type %1 in the first line, or press Esc to go back.</source>
        <translation>Das beendet den Versuch endgültig. Tippen Sie %1 in die erste Zeile, oder drücken Sie Esc, um zurückzugehen.</translation>
    </message>
    <message>
        <source>“%1” is not the code of this participant. Type %2 in the first line, or press Esc to go back.</source>
        <translation>„%1“ ist nicht der Code dieser Versuchsperson. Tippen Sie %2 in die erste Zeile, oder drücken Sie Esc, um zurückzugehen.</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Describe the event in a few words. The program stores the note with its time.</source>
        <translation>Beschreiben Sie das Ereignis in wenigen Worten. Das Programm speichert die Notiz mit ihrer Zeit.</translation>
    </message>
    <message>
        <source>Store the note (Enter)</source>
        <translation>Notiz speichern (Enter)</translation>
    </message>
    <message>
        <source>The note is empty. Write a few words, or press Esc to go back.</source>
        <translation>Die Notiz ist leer. Schreiben Sie einige Worte, oder drücken Sie Esc, um zurückzugehen.</translation>
    </message>
    <message>
        <source>Flag the last presentation</source>
        <translation>Letzte Darbietung markieren</translation>
    </message>
    <message>
        <source>Flag presentation %1</source>
        <translation>Darbietung %1 markieren</translation>
    </message>
    <message>
        <source>The presentation stays in the analysis and is marked for inspection. You may add a reason.</source>
        <translation>Die Darbietung bleibt in der Auswertung und wird zur Durchsicht markiert. Sie können einen Grund angeben.</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Flag the presentation (Enter)</source>
        <translation>Darbietung markieren (Enter)</translation>
    </message>
    <message>
        <source>Void the last presentation</source>
        <translation>Letzte Darbietung für ungültig erklären</translation>
    </message>
    <message>
        <source>Void presentation %1</source>
        <translation>Darbietung %1 für ungültig erklären</translation>
    </message>
    <message>
        <source>Its answers are kept but not analysed. The presentation is repeated at the end of this block under another code. Why was it invalid?</source>
        <translation>Die Antworten darauf bleiben erhalten, werden aber nicht ausgewertet. Die Darbietung wird am Ende dieses Blocks unter einem anderen Code wiederholt. Warum war sie ungültig?</translation>
    </message>
    <message>
        <source>Void the presentation (Enter)</source>
        <translation>Für ungültig erklären (Enter)</translation>
    </message>
    <message>
        <source>The participant withdraws</source>
        <translation>Die Versuchsperson tritt zurück</translation>
    </message>
    <message>
        <source>This ends the session of %1 permanently. The answers so far are kept, and the study&apos;s owner gives the place out again. To stop for today, press Esc and then Q. Which reason did the participant give?</source>
        <translation>Das beendet den Versuch von %1 endgültig. Die bisherigen Antworten bleiben erhalten, und die Leitung der Studie vergibt den Platz wieder. Um nur für heute aufzuhören, drücken Sie Esc und dann Q. Welchen Grund hat die Versuchsperson genannt?</translation>
    </message>
    <message>
        <source>This ends the session of %1 permanently. The answers so far are kept, and another participant can take the place. To stop for today, press Esc and then Q. Which reason did the participant give?</source>
        <translation>Das beendet den Versuch von %1 endgültig. Die bisherigen Antworten bleiben erhalten, und eine andere Versuchsperson kann den Platz einnehmen. Um nur für heute aufzuhören, drücken Sie Esc und dann Q. Welchen Grund hat die Versuchsperson genannt?</translation>
    </message>
    <message>
        <source>End the session (Enter)</source>
        <translation>Versuch beenden (Enter)</translation>
    </message>
    <message>
        <source>The participant need not give a reason. Press Enter again to end the session, Esc to go back.</source>
        <translation>Die Versuchsperson muss keinen Grund nennen. Drücken Sie noch einmal Enter, um den Versuch zu beenden, Esc, um zurückzugehen.</translation>
    </message>
    <message>
        <source>Usual reasons</source>
        <translation>Übliche Gründe</translation>
    </message>
    <message>
        <source>Wrong piece on the tray</source>
        <translation>Falsche Probe auf dem Tablett</translation>
    </message>
    <message>
        <source>Disturbance in the room</source>
        <translation>Störung im Raum</translation>
    </message>
    <message>
        <source>Fault of the display</source>
        <translation>Fehler des Displays</translation>
    </message>
    <message>
        <source>Slip of the operator</source>
        <translation>Versehen der Versuchsleitung</translation>
    </message>
    <message>
        <source>%1 (Alt %2)</source>
        <translation>%1 (Alt %2)</translation>
    </message>
    <message>
        <source>Write a short reason, or choose one with Alt 1 to Alt 4. Press Esc to go back.</source>
        <translation>Schreiben Sie einen kurzen Grund, oder wählen Sie einen mit Alt 1 bis Alt 4. Mit Esc gehen Sie zurück.</translation>
    </message>
</context>
<context>
    <name>study::app::RehearsalPage</name>
    <message>
        <source>a display</source>
        <translation>ein Display</translation>
    </message>
    <message>
        <source>a test pattern that was felt</source>
        <translation>ein gefühltes Testmuster</translation>
    </message>
    <message>
        <source>the masking sound</source>
        <translation>das Maskierungsrauschen</translation>
    </message>
    <message>
        <source>the sheets</source>
        <translation>die Bögen</translation>
    </message>
    <message>
        <source>one fabric piece</source>
        <translation>eine Stoffprobe</translation>
    </message>
    <message>
        <source>%1 fabric pieces</source>
        <translation>%1 Stoffproben</translation>
    </message>
    <message>
        <source>a disk in order</source>
        <translation>ein Datenträger in Ordnung</translation>
    </message>
    <message>
        <source>a clock in order</source>
        <translation>eine Uhr in Ordnung</translation>
    </message>
    <message>
        <source>a session played to its end</source>
        <translation>ein zu Ende gespielter Versuch</translation>
    </message>
    <message>
        <source>Code of a fabric piece</source>
        <translation>Code einer Stoffprobe</translation>
    </message>
    <message>
        <source>Play the session (F5)</source>
        <translation>Versuch durchspielen (F5)</translation>
    </message>
    <message>
        <source>Display… (F6)</source>
        <translation>Display … (F6)</translation>
    </message>
    <message>
        <source>Check again (F7)</source>
        <translation>Noch einmal prüfen (F7)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Rehearsal</source>
        <translation>Probelauf</translation>
    </message>
    <message>
        <source>Try everything once before the first participant comes. Nothing of it becomes data.</source>
        <translation>Probieren Sie alles einmal aus, bevor die erste Versuchsperson kommt. Nichts davon wird zu Daten.</translation>
    </message>
    <message>
        <source>An edge or a grating was felt on the display.</source>
        <translation>Auf dem Display war eine Kante oder ein Gitter zu fühlen.</translation>
    </message>
    <message>
        <source>With the headphones on, the masking sound is heard, and the display and the fabrics are not. F4 plays it.</source>
        <translation>Mit Kopfhörern ist das Rauschen zu hören, Display und Stoffe dagegen nicht. F4 spielt es ab.</translation>
    </message>
    <message>
        <source>The sheets are printed: labels on the pieces, consent, facts, scale.</source>
        <translation>Die Bögen sind gedruckt: Etiketten an den Proben, Einwilligung, Angaben, Skala.</translation>
    </message>
    <message>
        <source>The session was left before its end. Play it again to see all of it.</source>
        <translation>Der Versuch wurde vor dem Ende verlassen. Spielen Sie ihn noch einmal durch, um alles zu sehen.</translation>
    </message>
    <message>
        <source>%1 is there.</source>
        <translation>%1 ist da.</translation>
    </message>
    <message>
        <source>%1 was read before.</source>
        <translation>%1 wurde schon gelesen.</translation>
    </message>
    <message>
        <source>%1 is no code of this study. Read the label on the piece.</source>
        <translation>%1 ist kein Code dieser Studie. Lesen Sie das Etikett der Probe.</translation>
    </message>
    <message>
        <source>Display: %1 is connected.</source>
        <translation>Display: %1 ist verbunden.</translation>
    </message>
    <message>
        <source>No display is connected. Choose one on the page of the display.</source>
        <translation>Kein Display ist verbunden. Wählen Sie eines auf der Seite „Display“.</translation>
    </message>
    <message>
        <source>Every fabric piece is there.</source>
        <translation>Alle Stoffproben sind da.</translation>
    </message>
    <message>
        <source>Scan or type the code of every fabric piece. Still to come: %1</source>
        <translation>Scannen oder tippen Sie den Code jeder Stoffprobe. Es fehlen noch: %1</translation>
    </message>
    <message>
        <source>The disk is in order.</source>
        <translation>Der Datenträger ist in Ordnung.</translation>
    </message>
    <message>
        <source>The clock is in order.</source>
        <translation>Die Uhr ist in Ordnung.</translation>
    </message>
    <message>
        <source>The clock was not compared with the study.</source>
        <translation>Die Uhr wurde nicht mit der Studie verglichen.</translation>
    </message>
    <message>
        <source>The session was played to its end.</source>
        <translation>Der Versuch wurde bis zum Ende durchgespielt.</translation>
    </message>
    <message>
        <source>Play the session: every page, a few presentations of each part, a break. Its images are patterns, not those of the study.</source>
        <translation>Spielen Sie den Versuch durch: jede Seite, aus jedem Teil einige Darbietungen, eine Pause. Seine Bilder sind Muster, nicht die der Studie.</translation>
    </message>
    <message>
        <source>Ready for %1.</source>
        <translation>Bereit für %1.</translation>
    </message>
    <message>
        <source>Still missing: %1.</source>
        <translation>Noch offen: %1.</translation>
    </message>
</context>
<context>
    <name>study::app::ScaleLine</name>
    <message>
        <source>Scale line from %1 to %2</source>
        <translation>Skalenlinie von %1 bis %2</translation>
    </message>
    <message>
        <source>nothing chosen</source>
        <translation>nichts gewählt</translation>
    </message>
</context>
<context>
    <name>study::app::ScaleTrainingPage</name>
    <message>
        <source>Number that the participant says for the mark</source>
        <translation>Zahl, die die Versuchsperson für die Marke sagt</translation>
    </message>
    <message>
        <source>Continue (Enter)</source>
        <translation>Fortfahren (Enter)</translation>
    </message>
    <message>
        <source>The participant knows the scale (G)</source>
        <translation>Die Versuchsperson kennt die Skala (G)</translation>
    </message>
    <message>
        <source>Repeat the scale</source>
        <translation>Die Skala wiederholen</translation>
    </message>
    <message>
        <source>Show this line again. Say: “%1”</source>
        <translation>Zeigen Sie diese Linie noch einmal. Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Show this line again, from %1 to %2.</source>
        <translation>Zeigen Sie diese Linie noch einmal, von %1 bis %2.</translation>
    </message>
    <message>
        <source>Learn the scale</source>
        <translation>Die Skala lernen</translation>
    </message>
    <message>
        <source>Show this line to the participant. Its sections are equal, and only its ends have numbers.</source>
        <translation>Zeigen Sie der Versuchsperson diese Linie. Ihre Abschnitte sind gleich lang, und nur ihre Enden haben Zahlen.</translation>
    </message>
    <message>
        <source>Show this line to the participant. Only its ends have numbers.</source>
        <translation>Zeigen Sie der Versuchsperson diese Linie. Nur ihre Enden haben Zahlen.</translation>
    </message>
    <message>
        <source>Let the participant touch sandpaper, then silk. Say: “%1”</source>
        <translation>Lassen Sie die Versuchsperson Schleifpapier und dann Seide fühlen. Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Let the participant touch two pieces of the same fabric. Say: “%1”</source>
        <translation>Lassen Sie die Versuchsperson zwei Proben desselben Stoffs fühlen. Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Ask: “%1”</source>
        <translation>Fragen Sie: „%1“</translation>
    </message>
    <message>
        <source>Mark %1; right in a row: %2 of 3. Ask: “%3”</source>
        <translation>Marke %1; richtig in Folge: %2 von 3. Fragen Sie: „%3“</translation>
    </message>
    <message>
        <source>Store this number (Enter)</source>
        <translation>Diese Zahl speichern (Enter)</translation>
    </message>
    <message>
        <source>The participant knows the scale (Enter)</source>
        <translation>Die Versuchsperson kennt die Skala (Enter)</translation>
    </message>
    <message>
        <source>The participant said %1. The mark was exactly there.</source>
        <translation>Die Versuchsperson sagte %1. Die Marke war genau dort.</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is very close.</source>
        <translation>Die Versuchsperson sagte %1, und die Marke war bei %2. Das ist sehr nahe.</translation>
    </message>
    <message>
        <source>%1 too high</source>
        <translation>%1 zu hoch</translation>
    </message>
    <message>
        <source>%1 too low</source>
        <translation>%1 zu tief</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is close, %3.</source>
        <translation>Die Versuchsperson sagte %1, und die Marke war bei %2. Das ist nahe, %3.</translation>
    </message>
    <message>
        <source>The participant said %1, and the mark was at %2. This is %3. Show the ends and the sections again.</source>
        <translation>Die Versuchsperson sagte %1, und die Marke war bei %2. Das ist %3. Zeigen Sie noch einmal die Enden und die Abschnitte.</translation>
    </message>
    <message>
        <source>%1 Press G to skip this if the participant already knows the scale.</source>
        <translation>%1 Drücken Sie G, um das zu überspringen, wenn die Versuchsperson die Skala schon kennt.</translation>
    </message>
    <message>
        <source>Let the participant touch your materials (usually sandpaper, then silk). Say: “%1”</source>
        <translation>Lassen Sie die Versuchsperson Ihre Materialien fühlen (üblich: Schleifpapier, dann Seide). Sagen Sie: „%1“</translation>
    </message>
    <message>
        <source>Let the participant touch your materials (usually two pieces of the same fabric). Say: “%1”</source>
        <translation>Lassen Sie die Versuchsperson Ihre Materialien fühlen (üblich: zwei Proben desselben Stoffs). Sagen Sie: „%1“</translation>
    </message>
</context>
<context>
    <name>study::app::ScreenCover</name>
    <message>
        <source>Cover of the haptic display</source>
        <translation>Abdeckung des haptischen Displays</translation>
    </message>
</context>
<context>
    <name>study::app::SectionTabs</name>
    <message>
        <source>Section of the protocol</source>
        <translation>Abschnitt des Protokolls</translation>
    </message>
    <message>
        <source>1  Study</source>
        <translation>1  Studie</translation>
    </message>
    <message>
        <source>2  Conditions</source>
        <translation>2  Bedingungen</translation>
    </message>
    <message>
        <source>3  Questions</source>
        <translation>3  Fragen</translation>
    </message>
    <message>
        <source>4  Course</source>
        <translation>4  Ablauf</translation>
    </message>
    <message>
        <source>5  Texts</source>
        <translation>5  Texte</translation>
    </message>
    <message>
        <source>6  Analysis</source>
        <translation>6  Auswertung</translation>
    </message>
</context>
<context>
    <name>study::app::ServerBar</name>
    <message>
        <source>Station %1: the server takes nothing from this station now.</source>
        <translation>Station %1: Der Server nimmt von dieser Station zurzeit nichts an.</translation>
    </message>
    <message>
        <source>Station %1: the server cannot be reached.</source>
        <translation>Station %1: Der Server ist nicht erreichbar.</translation>
    </message>
    <message>
        <source>No entry waits on this computer.</source>
        <translation>Auf diesem Rechner wartet kein Eintrag.</translation>
    </message>
    <message>
        <source>Entries that wait on this computer: %1. They are sent when the server takes them.</source>
        <translation>Einträge, die auf diesem Rechner warten: %1. Sie werden gesendet, sobald der Server sie annimmt.</translation>
    </message>
    <message>
        <source>Reason: %1</source>
        <translation>Grund: %1</translation>
    </message>
    <message>
        <source>Station %1: entries wait on this computer: %2. They are being sent.</source>
        <translation>Station %1: Auf diesem Rechner warten Einträge: %2. Sie werden gerade gesendet.</translation>
    </message>
    <message>
        <source>The server lost entries after entry %1 that this station had seen. Ask the study&apos;s owner before anybody goes on.</source>
        <translation>Dem Server fehlen Einträge nach Eintrag %1, die diese Station gesehen hatte. Fragen Sie die Leitung der Studie, bevor jemand weitermacht.</translation>
    </message>
    <message>
        <source>The clock of this computer is %1 s ahead of the server&apos;s clock. Set it before the next session.</source>
        <translation>Die Uhr dieses Rechners geht gegenüber der Uhr des Servers %1 s vor. Stellen Sie sie vor der nächsten Sitzung.</translation>
    </message>
    <message>
        <source>The clock of this computer is %1 s behind the server&apos;s clock. Set it before the next session.</source>
        <translation>Die Uhr dieses Rechners geht gegenüber der Uhr des Servers %1 s nach. Stellen Sie sie vor der nächsten Sitzung.</translation>
    </message>
    <message>
        <source>Station %1: every answer is on the server.</source>
        <translation>Station %1: Alle Antworten liegen auf dem Server.</translation>
    </message>
</context>
<context>
    <name>study::app::ServerMonitor</name>
    <message>
        <source>The server of %1 cannot be reached. The window shows what it read last and tries again every two seconds.</source>
        <translation>Der Server von %1 ist nicht erreichbar. Das Fenster zeigt, was es zuletzt gelesen hat, und versucht es alle zwei Sekunden noch einmal.</translation>
    </message>
    <message>
        <source>%1. The window tries again in two seconds.</source>
        <translation>%1. Das Fenster versucht es in zwei Sekunden noch einmal.</translation>
    </message>
</context>
<context>
    <name>study::app::SessionController</name>
    <message>
        <source>The presentation is flagged.</source>
        <translation>Die Darbietung ist markiert.</translation>
    </message>
    <message>
        <source>The note is stored.</source>
        <translation>Die Notiz ist gespeichert.</translation>
    </message>
    <message>
        <source>The answer is corrected. The study keeps the old answer.</source>
        <translation>Die Antwort ist berichtigt. Die Studie bewahrt die alte Antwort auf.</translation>
    </message>
    <message>
        <source>The presentation is void. It will be repeated under another code.</source>
        <translation>Die Darbietung ist ungültig. Sie wird unter einem anderen Code wiederholt.</translation>
    </message>
    <message>
        <source>%1. The session is paused and no answer is lost. Fix the problem, then press Enter to continue.</source>
        <translation>%1. Der Versuch ist angehalten, und keine Antwort ist verloren. Beheben Sie die Störung und drücken Sie dann Enter, um fortzufahren.</translation>
    </message>
    <message>
        <source>%1. Your last entry was not stored. Fix the problem, then enter it again.</source>
        <translation>%1. Ihre letzte Eingabe wurde nicht gespeichert. Beheben Sie die Störung und geben Sie sie dann noch einmal ein.</translation>
    </message>
    <message>
        <source>Say if needed: “%1”</source>
        <translation>Sagen Sie bei Bedarf: „%1“</translation>
    </message>
    <message>
        <source>Your last entry was stored. After it the head of the log could not be read: %1. Fix the problem, then go on.</source>
        <translation>Ihre letzte Eingabe wurde gespeichert. Danach ließ sich der Logbuch-Stand nicht lesen: %1. Beheben Sie die Störung und machen Sie dann weiter.</translation>
    </message>
</context>
<context>
    <name>study::app::SessionFooter</name>
    <message>
        <source>Correct</source>
        <translation>Berichtigen</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Flag</source>
        <translation>Markieren</translation>
    </message>
    <message>
        <source>Void</source>
        <translation>Ungültig</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Stop for now</source>
        <translation>Für jetzt aufhören</translation>
    </message>
    <message>
        <source>Withdrawal</source>
        <translation>Rücktritt</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Alt %1</source>
        <translation>Alt %1</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1 oder %2</translation>
    </message>
    <message>
        <source>Last answer  %1</source>
        <translation>Letzte Antwort  %1</translation>
    </message>
    <message>
        <source>No answer yet</source>
        <translation>Noch keine Antwort</translation>
    </message>
</context>
<context>
    <name>study::app::SessionHeader</name>
    <message>
        <source>Answers stored</source>
        <translation>Gespeicherte Antworten</translation>
    </message>
    <message>
        <source>NO DISPLAY: rehearsal</source>
        <translation>KEIN DISPLAY: Probelauf</translation>
    </message>
    <message>
        <source>Display on: %1 (%2)</source>
        <translation>Display an: %1 (%2)</translation>
    </message>
    <message>
        <source>Display on: %1</source>
        <translation>Display an: %1</translation>
    </message>
    <message>
        <source>Display off: %1</source>
        <translation>Display aus: %1</translation>
    </message>
    <message>
        <source>REHEARSAL: nothing becomes data</source>
        <translation>PROBELAUF: Nichts wird zu Daten</translation>
    </message>
    <message>
        <source>Participant %1</source>
        <translation>Versuchsperson %1</translation>
    </message>
    <message>
        <source>Presentation %1 of %2</source>
        <translation>Darbietung %1 von %2</translation>
    </message>
    <message>
        <source>Answers %1 of %2</source>
        <translation>Antworten %1 von %2</translation>
    </message>
    <message>
        <source>About %1 min left</source>
        <translation>Noch etwa %1 min</translation>
    </message>
    <message>
        <source>This sitting: %1 of %2 min</source>
        <translation>Diese Sitzung: %1 von %2 min</translation>
    </message>
    <message>
        <source>Presentations to next break: %1</source>
        <translation>Darbietungen bis zur nächsten Pause: %1</translation>
    </message>
</context>
<context>
    <name>study::app::SessionPage</name>
    <message>
        <source>Your text is not stored yet. Store it first, or go on without it.</source>
        <translation>Ihr Text ist noch nicht gespeichert. Speichern Sie ihn zuerst, oder gehen Sie ohne ihn weiter.</translation>
    </message>
    <message>
        <source>Go on without storing</source>
        <translation>Weiter ohne zu speichern</translation>
    </message>
    <message>
        <source>Stay (Esc)</source>
        <translation>Bleiben (Esc)</translation>
    </message>
    <message>
        <source>The participant agreed on their own screen.</source>
        <translation>Die Versuchsperson hat auf ihrem eigenen Bildschirm eingewilligt.</translation>
    </message>
    <message>
        <source>The participant does not agree. Speak with them. W ends the session.</source>
        <translation>Die Versuchsperson willigt nicht ein. Sprechen Sie mit ihr. W beendet den Versuch.</translation>
    </message>
    <message>
        <source>If they agree now, press Enter once more.</source>
        <translation>Wenn sie jetzt einwilligt, drücken Sie noch einmal Enter.</translation>
    </message>
    <message>
        <source>The participant answered on their own screen.</source>
        <translation>Die Versuchsperson hat auf ihrem eigenen Bildschirm geantwortet.</translation>
    </message>
    <message>
        <source>A scanner typed this, so nothing was stored. Enter the answer by hand.</source>
        <translation>Ein Barcode-Leser hat das getippt; nichts wurde gespeichert. Geben Sie die Antwort von Hand ein.</translation>
    </message>
    <message>
        <source>The participant has just moved the session on, so your entry did nothing. Enter it again.</source>
        <translation>Die Versuchsperson hat den Versuch eben selbst weitergeführt; Ihre Eingabe hat nichts bewirkt. Geben Sie sie noch einmal ein.</translation>
    </message>
</context>
<context>
    <name>study::app::SessionRoom</name>
    <message>
        <source>%1. F4 opens the page of the headphones.</source>
        <translation>%1. F4 öffnet die Seite der Kopfhörer.</translation>
    </message>
    <message>
        <source>%1. The pause was not stored, so the session is still open. Fix the problem, or leave once more: no stored answer is lost.</source>
        <translation>%1. Die Pause wurde nicht gespeichert, der Versuch ist deshalb noch offen. Beheben Sie das Problem, oder verlassen Sie ihn noch einmal: Keine gespeicherte Antwort geht verloren.</translation>
    </message>
</context>
<context>
    <name>study::app::SlotCard</name>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>confirmed ✓</source>
        <translation>bestätigt ✓</translation>
    </message>
    <message>
        <source>Slot %1: %2</source>
        <translation>Feld %1: %2</translation>
    </message>
</context>
<context>
    <name>study::app::StartPage</name>
    <message>
        <source>Study folder</source>
        <translation>Ordner der Studie</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Open the study (Enter)</source>
        <translation>Studie öffnen (Enter)</translation>
    </message>
    <message>
        <source>Create a new study…</source>
        <translation>Neue Studie anlegen …</translation>
    </message>
    <message>
        <source>Look at a data set…</source>
        <translation>Datensatz ansehen …</translation>
    </message>
    <message>
        <source>Data set from photographs…</source>
        <translation>Datensatz aus Fotos …</translation>
    </message>
    <message>
        <source>Display…</source>
        <translation>Display …</translation>
    </message>
    <message>
        <source>Keys and pedals…</source>
        <translation>Tasten und Pedale …</translation>
    </message>
    <message>
        <source>Participant&apos;s screen… (F4)</source>
        <translation>Bildschirm der Versuchsperson … (F4)</translation>
    </message>
    <message>
        <source>Vis2Hap</source>
        <translation>Vis2Hap</translation>
    </message>
    <message>
        <source>Blinded studies of how rendered fabrics feel.</source>
        <translation>Verblindete Studien dazu, wie sich gerenderte Stoffe anfühlen.</translation>
    </message>
    <message>
        <source>Recent studies</source>
        <translation>Zuletzt geöffnete Studien</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Language of this window</source>
        <translation>Sprache dieses Fensters</translation>
    </message>
    <message>
        <source>translation not reviewed</source>
        <translation>Übersetzung nicht geprüft</translation>
    </message>
    <message>
        <source>translation reviewed by %1</source>
        <translation>Übersetzung geprüft von %1</translation>
    </message>
    <message>
        <source>No study yet? Photographs of fabrics become a data set, and a data set becomes a study.</source>
        <translation>Noch keine Studie? Aus Fotos von Stoffen wird ein Datensatz, und aus einem Datensatz eine Studie.</translation>
    </message>
    <message>
        <source>No folder is given. Type the study folder, or choose it with Browse.</source>
        <translation>Es ist kein Ordner angegeben. Tippen Sie den Ordner der Studie oder wählen Sie ihn mit „Durchsuchen“.</translation>
    </message>
    <message>
        <source>Make a protocol…</source>
        <translation>Protokoll anlegen …</translation>
    </message>
    <message>
        <source>Change a protocol…</source>
        <translation>Protokoll ändern …</translation>
    </message>
    <message>
        <source>the folder that contains study.db, or an address postgresql://USER@HOST/DATABASE?study=NAME</source>
        <translation>der Ordner mit study.db, oder eine Adresse postgresql://USER@HOST/DATABASE?study=NAME</translation>
    </message>
    <message>
        <source>Watch the study…</source>
        <translation>Studie beobachten …</translation>
    </message>
</context>
<context>
    <name>study::app::StepWork</name>
    <message>
        <source>Stopped. Nothing was written.</source>
        <translation>Abgebrochen. Nichts wurde geschrieben.</translation>
    </message>
    <message>
        <source>%1: %2 %. Esc stops it.</source>
        <translation>%1: %2 %. Esc bricht ab.</translation>
    </message>
</context>
<context>
    <name>study::app::StudyPage</name>
    <message>
        <source>There is no rehearsal at a station: the images and the codes of the pieces lie on the server. Rehearse in the study&apos;s folder before it moves there.</source>
        <translation>An einer Station gibt es keinen Probelauf: Die Bilder und die Codes der Stoffproben liegen auf dem Server. Machen Sie den Probelauf im Ordner der Studie, bevor sie dorthin umzieht.</translation>
    </message>
    <message>
        <source>Code of the participant who goes on</source>
        <translation>Code der Versuchsperson, die weitermacht</translation>
    </message>
    <message>
        <source>Continue a session</source>
        <translation>Versuch fortsetzen</translation>
    </message>
    <message>
        <source>Code of the next participant</source>
        <translation>Code der nächsten Versuchsperson</translation>
    </message>
    <message>
        <source>Enrol and begin (Enter)</source>
        <translation>Aufnehmen und beginnen (Enter)</translation>
    </message>
    <message>
        <source>Display…</source>
        <translation>Display …</translation>
    </message>
    <message>
        <source>Keys…</source>
        <translation>Tasten …</translation>
    </message>
    <message>
        <source>Participant&apos;s screen… (F4)</source>
        <translation>Bildschirm der Versuchsperson … (F4)</translation>
    </message>
    <message>
        <source>Close the study (Esc)</source>
        <translation>Studie schließen (Esc)</translation>
    </message>
    <message>
        <source>Tools… (F2)</source>
        <translation>Werkzeuge … (F2)</translation>
    </message>
    <message>
        <source>Rehearse… (F8)</source>
        <translation>Probelauf … (F8)</translation>
    </message>
    <message>
        <source>Places of the study</source>
        <translation>Plätze der Studie</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Platz</translation>
    </message>
    <message>
        <source>Participant</source>
        <translation>Versuchsperson</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>Answers</source>
        <translation>Antworten</translation>
    </message>
    <message>
        <source>Next participant</source>
        <translation>Nächste Versuchsperson</translation>
    </message>
    <message>
        <source>Type a code, not the name of the person.</source>
        <translation>Tippen Sie einen Code, nicht den Namen der Person.</translation>
    </message>
    <message>
        <source>Session in progress</source>
        <translation>Laufender Versuch</translation>
    </message>
    <message>
        <source>Type the code of the participant who is here.</source>
        <translation>Tippen Sie den Code der Versuchsperson, die hier ist.</translation>
    </message>
    <message>
        <source>Finished %1  ·  in progress %2  ·  free %3</source>
        <translation>Fertig %1  ·  laufend %2  ·  frei %3</translation>
    </message>
    <message>
        <source>%1  ·  withdrawn %2</source>
        <translation>%1  ·  zurückgetreten %2</translation>
    </message>
    <message>
        <source>No place is free. Places of participants who withdrew wait for the study&apos;s owner, who gives them out: vis2hap server roles ADDRESS --release-held. Then open the study again.</source>
        <translation>Kein Platz ist frei. Plätze zurückgetretener Versuchspersonen warten auf die Leitung der Studie, die sie freigibt: vis2hap server roles ADDRESS --release-held. Öffnen Sie danach die Studie noch einmal.</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>free</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>finished</source>
        <translation>fertig</translation>
    </message>
    <message>
        <source>withdrawn, place freed</source>
        <translation>zurückgetreten, Platz wieder frei</translation>
    </message>
    <message>
        <source>withdrawn, waits for the owner</source>
        <translation>zurückgetreten, wartet auf die Leitung</translation>
    </message>
    <message>
        <source>%1, scripted</source>
        <translation>%1, nach Skript</translation>
    </message>
    <message>
        <source>%1, simulated</source>
        <translation>%1, simuliert</translation>
    </message>
    <message>
        <source>Continue with %1</source>
        <translation>Mit %1 fortfahren</translation>
    </message>
    <message>
        <source>Choose a participant whose session has started but is not finished.</source>
        <translation>Wählen Sie eine Versuchsperson, deren Versuch begonnen hat, aber nicht fertig ist.</translation>
    </message>
    <message>
        <source>Type %1 to continue with this participant.</source>
        <translation>Tippen Sie %1, um mit dieser Versuchsperson fortzufahren.</translation>
    </message>
    <message>
        <source>%1 is chosen in the list, and %2 is typed. Choose and type the same participant.</source>
        <translation>In der Liste ist %1 gewählt, getippt ist %2. Wählen und tippen Sie dieselbe Versuchsperson.</translation>
    </message>
    <message>
        <source>Type a code for the next participant, such as %1.</source>
        <translation>Tippen Sie einen Code für die nächste Versuchsperson, zum Beispiel %1.</translation>
    </message>
    <message>
        <source>This code %1. Type another code, such as %2.</source>
        <translation>Dieser Code %1. Tippen Sie einen anderen Code, zum Beispiel %2.</translation>
    </message>
    <message>
        <source>This code %1. Type at most %2 letters and digits, such as %3.</source>
        <translation>Dieser Code %1. Tippen Sie höchstens %2 Buchstaben und Ziffern, zum Beispiel %3.</translation>
    </message>
    <message>
        <source>%1 has withdrawn. Type another code.</source>
        <translation>%1 ist zurückgetreten. Tippen Sie einen anderen Code.</translation>
    </message>
    <message>
        <source>%1 is already enrolled. Choose this participant in the list to continue, or type another code.</source>
        <translation>%1 ist schon aufgenommen. Wählen Sie diese Versuchsperson in der Liste, um fortzufahren, oder tippen Sie einen anderen Code.</translation>
    </message>
    <message>
        <source>A session is in progress. Press Enter again to enrol %1 as a new participant.</source>
        <translation>Ein Versuch läuft noch. Drücken Sie noch einmal Enter, um %1 als neue Versuchsperson aufzunehmen.</translation>
    </message>
    <message>
        <source>The study is made. Look at these remarks before the first session:</source>
        <translation>Die Studie ist angelegt. Lesen Sie diese Hinweise vor dem ersten Versuch:</translation>
    </message>
    <message>
        <source>And %1 more.</source>
        <translation>Und %1 weitere.</translation>
    </message>
</context>
<context>
    <name>study::app::StudySection</name>
    <message>
        <source>Fabrics</source>
        <translation>Stoffe</translation>
    </message>
    <message>
        <source>Choose fabrics of a data set…</source>
        <translation>Stoffe eines Datensatzes wählen …</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>Studie</translation>
    </message>
    <message>
        <source>Every participant feels each fabric under each condition. The numbers beside show what that takes.</source>
        <translation>Jede Versuchsperson fühlt jeden Stoff unter jeder Bedingung. Die Zahlen daneben zeigen, was das verlangt.</translation>
    </message>
    <message>
        <source>Name of the study</source>
        <translation>Name der Studie</translation>
    </message>
    <message>
        <source>Five words for five fabrics</source>
        <translation>Fünf Wörter für fünf Stoffe</translation>
    </message>
    <message>
        <source>Participants</source>
        <translation>Versuchspersonen</translation>
    </message>
    <message>
        <source>Fabrics: a number, which are drawn from the data set, or ids with commas</source>
        <translation>Stoffe: eine Anzahl, die aus dem Datensatz gezogen wird, oder Kennungen mit Kommas</translation>
    </message>
    <message>
        <source>5, or F01, F04, F07</source>
        <translation>5, oder F01, F04, F07</translation>
    </message>
    <message>
        <source>Fabrics of the data set; Space chooses</source>
        <translation>Stoffe des Datensatzes; die Leertaste wählt</translation>
    </message>
    <message>
        <source>Fabric data set</source>
        <translation>Stoff-Datensatz</translation>
    </message>
</context>
<context>
    <name>study::app::ToolsPage</name>
    <message>
        <source>Folder for new files</source>
        <translation>Ordner für neue Dateien</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen …</translation>
    </message>
    <message>
        <source>Live monitor (M)</source>
        <translation>Laufende Beobachtung (M)</translation>
    </message>
    <message>
        <source>Open what was made (O)</source>
        <translation>Erzeugtes öffnen (O)</translation>
    </message>
    <message>
        <source>Back (Esc)</source>
        <translation>Zurück (Esc)</translation>
    </message>
    <message>
        <source>Tools of the study</source>
        <translation>Werkzeuge der Studie</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Ansehen</translation>
    </message>
    <message>
        <source>Status (S)</source>
        <translation>Stand (S)</translation>
    </message>
    <message>
        <source>Verify the study (V)</source>
        <translation>Studie überprüfen (V)</translation>
    </message>
    <message>
        <source>Write into a folder</source>
        <translation>In einen Ordner schreiben</translation>
    </message>
    <message>
        <source>Each button makes a new file or folder there. Nothing that exists is overwritten.</source>
        <translation>Jeder Knopf legt dort eine neue Datei oder einen neuen Ordner an. Nichts Vorhandenes wird überschrieben.</translation>
    </message>
    <message>
        <source>Sheets to print (P)</source>
        <translation>Bögen zum Drucken (P)</translation>
    </message>
    <message>
        <source>Backup (B)</source>
        <translation>Sicherung (B)</translation>
    </message>
    <message>
        <source>Export (E)</source>
        <translation>Export (E)</translation>
    </message>
    <message>
        <source>Report (R)</source>
        <translation>Bericht (R)</translation>
    </message>
    <message>
        <source>Data sheet (D)</source>
        <translation>Datenblatt (D)</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Stopped. Nothing was written.</source>
        <translation>Abgebrochen. Nichts wurde geschrieben.</translation>
    </message>
    <message>
        <source>%1: %2 %</source>
        <translation>%1: %2 %</translation>
    </message>
    <message>
        <source>Working… Esc stops long work.</source>
        <translation>In Arbeit … Esc bricht lange Arbeit ab.</translation>
    </message>
    <message>
        <source>The study has faults. Keep it as it is, make a backup, and show the list to its owner.</source>
        <translation>Die Studie hat Fehler. Lassen Sie sie, wie sie ist, machen Sie eine Sicherung und zeigen Sie die Liste der Person, der die Studie gehört.</translation>
    </message>
    <message>
        <source>Written: %1</source>
        <translation>Geschrieben: %1</translation>
    </message>
    <message>
        <source>Done. Nothing was written.</source>
        <translation>Erledigt. Nichts wurde geschrieben.</translation>
    </message>
    <message>
        <source>Stop (Esc)</source>
        <translation>Abbrechen (Esc)</translation>
    </message>
    <message>
        <source>Stopping after this step…</source>
        <translation>Wird nach diesem Schritt abgebrochen …</translation>
    </message>
    <message>
        <source>No program opens this here. Open it yourself: %1</source>
        <translation>Kein Programm öffnet das hier. Öffnen Sie es selbst: %1</translation>
    </message>
</context>
<context>
    <name>study::app::TouchButton</name>
    <message>
        <source>Stamp the first touch (T)</source>
        <translation>Erste Berührung stempeln (T)</translation>
    </message>
    <message>
        <source>Alt T</source>
        <translation>Alt T</translation>
    </message>
    <message>
        <source>T</source>
        <translation>T</translation>
    </message>
    <message>
        <source>%1 or %2</source>
        <translation>%1 oder %2</translation>
    </message>
    <message>
        <source>The display reports the first touch (or press %1)</source>
        <translation>Das Display meldet die erste Berührung (oder drücken Sie %1)</translation>
    </message>
    <message>
        <source>Stamp the first touch (%1)</source>
        <translation>Erste Berührung stempeln (%1)</translation>
    </message>
    <message>
        <source>The display reported the first touch ✓</source>
        <translation>Das Display hat die erste Berührung gemeldet ✓</translation>
    </message>
    <message>
        <source>You stamped the first touch ✓</source>
        <translation>Sie haben die erste Berührung gestempelt ✓</translation>
    </message>
</context>
<context>
    <name>study::app::TrayPage</name>
    <message>
        <source>Code of the next piece</source>
        <translation>Code der nächsten Probe</translation>
    </message>
    <message>
        <source>The tray is ready (Enter)</source>
        <translation>Das Tablett ist bereit (Enter)</translation>
    </message>
    <message>
        <source>The tray is ready</source>
        <translation>Das Tablett ist bereit</translation>
    </message>
    <message>
        <source>stays</source>
        <translation>bleibt</translation>
    </message>
    <message>
        <source>put here</source>
        <translation>hinlegen</translation>
    </message>
    <message>
        <source>from %1</source>
        <translation>von %1</translation>
    </message>
    <message>
        <source>Presentation %1</source>
        <translation>Darbietung %1</translation>
    </message>
    <message>
        <source>%1 is not the piece of slot %2. It must be %3.</source>
        <translation>%1 ist nicht die Probe für Feld %2. Es muss %3 sein.</translation>
    </message>
    <message>
        <source>All pieces are confirmed.</source>
        <translation>Alle Proben sind bestätigt.</translation>
    </message>
    <message>
        <source>Scan or type the piece in slot %1</source>
        <translation>Scannen oder tippen Sie die Probe in Feld %1</translation>
    </message>
    <message>
        <source>No question is asked yet, so this key is no answer. Look at the tray, then press Enter twice.</source>
        <translation>Noch ist keine Frage gestellt; diese Taste ist keine Antwort. Sehen Sie auf das Tablett und drücken Sie dann zweimal Enter.</translation>
    </message>
    <message>
        <source>Press Enter once more to confirm the tray.</source>
        <translation>Drücken Sie noch einmal Enter, um das Tablett zu bestätigen.</translation>
    </message>
</context>
<context>
    <name>study::app::WordsControls</name>
    <message>
        <source>Answer of the participant in words</source>
        <translation>Antwort der Versuchsperson in Worten</translation>
    </message>
    <message>
        <source>The answer is empty. Press Enter again to store an answer without words.</source>
        <translation>Die Antwort ist leer. Drücken Sie noch einmal Enter, um eine Antwort ohne Worte zu speichern.</translation>
    </message>
    <message>
        <source>Write the words of the participant. Press Shift and Enter for a new line.</source>
        <translation>Schreiben Sie die Worte der Versuchsperson. Umschalt und Enter ergeben eine neue Zeile.</translation>
    </message>
</context>
<context>
    <name>study::app::appearanceHint</name>
    <message>
        <source>Smaller text (Ctrl −)</source>
        <translation>Kleinerer Text (Strg −)</translation>
    </message>
    <message>
        <source>Larger text (Ctrl +)</source>
        <translation>Größerer Text (Strg +)</translation>
    </message>
    <message>
        <source>Light, dark or high contrast (Ctrl D)</source>
        <translation>Hell, dunkel oder hoher Kontrast (Strg D)</translation>
    </message>
</context>
<context>
    <name>study::making::SheetText</name>
    <message>
        <source>All participants</source>
        <translation>Alle Versuchspersonen</translation>
    </message>
    <message>
        <source>Place %1</source>
        <translation>Platz %1</translation>
    </message>
    <message>
        <source>en</source>
        <comment>language of the sheets</comment>
        <translation>de</translation>
    </message>
    <message>
        <source>1 entry</source>
        <translation>1 Eintrag</translation>
    </message>
    <message>
        <source>%1 entries</source>
        <translation>%1 Einträge</translation>
    </message>
    <message>
        <source>Cut out the labels. Fix each label to the back of its piece, as the preparation sheet shows.</source>
        <translation>Schneiden Sie die Etiketten aus. Befestigen Sie jedes auf der Rückseite seiner Stoffprobe, wie der Vorbereitungsbogen es zeigt.</translation>
    </message>
    <message>
        <source>The line on a label is below the code, so that nobody reads 199 as 661.</source>
        <translation>Die Linie auf einem Etikett liegt unter dem Code, damit niemand 199 als 661 liest.</translation>
    </message>
    <message>
        <source>%1: labels of the fabric pieces</source>
        <translation>%1: Etiketten der Stoffproben</translation>
    </message>
    <message>
        <source>For the person who labels the pieces. The operator of a session only needs the codes.</source>
        <translation>Für die Person, die die Proben etikettiert. Die Versuchsleitung braucht nur die Codes.</translation>
    </message>
    <message>
        <source>code</source>
        <translation>Code</translation>
    </message>
    <message>
        <source>fabric</source>
        <translation>Stoff</translation>
    </message>
    <message>
        <source>id</source>
        <translation>Kennung</translation>
    </message>
    <message>
        <source>You also need sandpaper, silk and a second piece of one fabric, for the two ends of the scale.</source>
        <translation>Sie brauchen außerdem Schleifpapier, Seide und eine zweite Probe eines Stoffs, für die beiden Enden der Skala.</translation>
    </message>
    <message>
        <source>%1: preparation of the fabric pieces</source>
        <translation>%1: Vorbereitung der Stoffproben</translation>
    </message>
    <message>
        <source>At the end of a sitting the app shows the head of the log. Copy it here: the number, the colon and the 16 digits. Keep this sheet away from the computer. It then shows later whether the log was cut, put back or written anew.</source>
        <translation>Am Ende einer Sitzung zeigt das Programm den Logbuch-Stand. Schreiben Sie ihn hier ab: die Zahl, den Doppelpunkt und die 16 Ziffern. Bewahren Sie diesen Bogen nicht beim Rechner auf. Er zeigt dann später, ob das Logbuch gekürzt, zurückgesetzt oder neu geschrieben wurde.</translation>
    </message>
    <message>
        <source>date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>participant</source>
        <translation>Versuchsperson</translation>
    </message>
    <message>
        <source>operator</source>
        <translation>Versuchsleitung</translation>
    </message>
    <message>
        <source>head of the log</source>
        <translation>Logbuch-Stand</translation>
    </message>
    <message>
        <source>%1: sittings</source>
        <translation>%1: Sitzungen</translation>
    </message>
    <message>
        <source>The app shows each sentence at the beginning of its block. Read it aloud.</source>
        <translation>Das Programm zeigt jeden Satz zu Beginn seines Blocks. Lesen Sie ihn vor.</translation>
    </message>
    <message>
        <source>questions</source>
        <translation>Fragen</translation>
    </message>
    <message>
        <source>instruction</source>
        <translation>Anweisung</translation>
    </message>
    <message>
        <source>sentence</source>
        <translation>Satz</translation>
    </message>
    <message>
        <source>Order</source>
        <translation>Reihenfolge</translation>
    </message>
    <message>
        <source>place</source>
        <translation>Platz</translation>
    </message>
    <message>
        <source>instructions</source>
        <translation>Anweisungen</translation>
    </message>
    <message>
        <source>%1: instructions of the blocks</source>
        <translation>%1: Anweisungen für die Blöcke</translation>
    </message>
    <message>
        <source>Head of the log when this page was made: %1 (%2). Check: %3</source>
        <translation>Logbuch-Stand, als diese Seite entstand: %1 (%2). Prüfen: %3</translation>
    </message>
    <message>
        <source>Fabrics for familiarisation with the display: %1.</source>
        <translation>Stoffe zum Kennenlernen des Displays: %1.</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between the names of a list</comment>
        <translation>, </translation>
    </message>
    <message>
        <source>You also need the materials for the two ends of the scale. The usual ones are sandpaper, silk and a second piece of one fabric. Your study&apos;s own texts may name others.</source>
        <translation>Sie brauchen auch die Materialien für die beiden Enden der Skala. Üblich sind Schleifpapier, Seide und eine zweite Probe eines Stoffs. Die eigenen Texte Ihrer Studie nennen vielleicht andere.</translation>
    </message>
</context>
</TS>

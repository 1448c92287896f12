-- A study of schema version 1 with one finished scripted session, as `sqlite3 study.db .dump` printed it.
PRAGMA application_id = 1446135888;
PRAGMA user_version = 1;
BEGIN TRANSACTION;
CREATE TABLE events(
        sequence INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, sitting INTEGER NOT NULL,
        kind TEXT NOT NULL, payload TEXT NOT NULL, at_ns INTEGER NOT NULL, wall_time TEXT NOT NULL,
        previous_hash TEXT NOT NULL, hash TEXT NOT NULL UNIQUE) STRICT;
INSERT INTO "events" VALUES(1,'',0,'created','{"fixed_sha256":"023bf08a238a7c3e4c95168c86a43d955e18b83ee86a362be1de4e6919415ac1"}',0,'2000-01-01T00:00:00.000Z','','1c7c5ecc52e3a003de1672efd7600fb5e5925e46312f6d2ee26bae63e5ae6d47');
INSERT INTO "events" VALUES(2,'',0,'enrolled','{"slot":1,"participant":"S01","kind":"scripted"}',0,'2026-11-21T14:43:02.208Z','1c7c5ecc52e3a003de1672efd7600fb5e5925e46312f6d2ee26bae63e5ae6d47','ad66aee70d5e839ce202147ee775fbd4fe628254a349384b3eb9dcaede03f743');
INSERT INTO "events" VALUES(3,'S01',1,'sitting_started','{}',0,'2000-01-01T00:00:00.000Z','ad66aee70d5e839ce202147ee775fbd4fe628254a349384b3eb9dcaede03f743','5c2b0ce370869a2a40f3e8f12706d7045b287a56f2004a6f43694247f1d056be');
INSERT INTO "events" VALUES(4,'S01',1,'begun','{}',0,'2000-01-01T00:00:00.000Z','5c2b0ce370869a2a40f3e8f12706d7045b287a56f2004a6f43694247f1d056be','db633f8872d70bd973bae4d3653a3f6fa3068cadb7bc87a585c1259af1160017');
INSERT INTO "events" VALUES(5,'S01',1,'familiarisation_done','{}',0,'2000-01-01T00:00:00.000Z','db633f8872d70bd973bae4d3653a3f6fa3068cadb7bc87a585c1259af1160017','20e6c3cf925ed669eee74f6a88b0a12e4f2730c2e44d28fc4073e92a6652b8b3');
INSERT INTO "events" VALUES(6,'S01',1,'scale_training_done','{}',0,'2000-01-01T00:00:00.000Z','20e6c3cf925ed669eee74f6a88b0a12e4f2730c2e44d28fc4073e92a6652b8b3','1c04c5c2baf750babc45c3dbf1de4f2fcfabba1bcb2a28b96b367f2c864da95f');
INSERT INTO "events" VALUES(7,'S01',1,'tray_ready','{}',0,'2000-01-01T00:00:00.000Z','1c04c5c2baf750babc45c3dbf1de4f2fcfabba1bcb2a28b96b367f2c864da95f','399e29bfb9866e69a503908634e0b3cea0dd85e07f373e5f6e621e5fdd39a087');
INSERT INTO "events" VALUES(8,'S01',1,'touched','{}',1250000000,'2000-01-01T00:00:01.250Z','399e29bfb9866e69a503908634e0b3cea0dd85e07f373e5f6e621e5fdd39a087','1a6cef7156de6aba60830a1594f27edc1c2c1879d63ffe6bae0a1d19ddd98dc0');
INSERT INTO "events" VALUES(9,'S01',1,'answered','{"fabric":"F01"}',3750000000,'2000-01-01T00:00:03.750Z','1a6cef7156de6aba60830a1594f27edc1c2c1879d63ffe6bae0a1d19ddd98dc0','a52e20e63e12427fef30b96c33b7ab9dec47cd160811eecd6e850c0d60b7fe15');
INSERT INTO "events" VALUES(10,'S01',1,'tray_ready','{}',3750000000,'2000-01-01T00:00:03.750Z','a52e20e63e12427fef30b96c33b7ab9dec47cd160811eecd6e850c0d60b7fe15','18a257bc06a40f49ce89cd92e825255e7e864d3f4fd281c502aa408eaa1cf859');
INSERT INTO "events" VALUES(11,'S01',1,'touched','{}',5000000000,'2000-01-01T00:00:05.000Z','18a257bc06a40f49ce89cd92e825255e7e864d3f4fd281c502aa408eaa1cf859','3eaaa575bba2d664fe905eac1ceb8d28017f3a050f9867365ae714b725b46003');
INSERT INTO "events" VALUES(12,'S01',1,'answered','{"fabric":"F03"}',7500000000,'2000-01-01T00:00:07.500Z','3eaaa575bba2d664fe905eac1ceb8d28017f3a050f9867365ae714b725b46003','2882fe334317d45abc9f5b41f57fcd067fb1de5b86f53942366fef09b8be5c59');
INSERT INTO "events" VALUES(13,'S01',1,'tray_ready','{}',7500000000,'2000-01-01T00:00:07.500Z','2882fe334317d45abc9f5b41f57fcd067fb1de5b86f53942366fef09b8be5c59','102dcc9e62dd0c98adc9b9ad612fe1cb55dde0dbe392211003a9e7312352606d');
INSERT INTO "events" VALUES(14,'S01',1,'touched','{}',8750000000,'2000-01-01T00:00:08.750Z','102dcc9e62dd0c98adc9b9ad612fe1cb55dde0dbe392211003a9e7312352606d','bb2d5ed59c4caf49078927f8c7496d85388de0b52ddef002db303eef5138c3ca');
INSERT INTO "events" VALUES(15,'S01',1,'answered','{"fabric":"F01"}',11250000000,'2000-01-01T00:00:11.250Z','bb2d5ed59c4caf49078927f8c7496d85388de0b52ddef002db303eef5138c3ca','f30a0f51851e79d00fa782e36501738699f385f2910aa0af6e4c9bd708f8a41f');
INSERT INTO "events" VALUES(16,'S01',1,'tray_ready','{}',11250000000,'2000-01-01T00:00:11.250Z','f30a0f51851e79d00fa782e36501738699f385f2910aa0af6e4c9bd708f8a41f','1fef16bdf49df743eb831a824cb4764d90e1aeafb594c7aef2631491f49e036d');
INSERT INTO "events" VALUES(17,'S01',1,'touched','{}',12500000000,'2000-01-01T00:00:12.500Z','1fef16bdf49df743eb831a824cb4764d90e1aeafb594c7aef2631491f49e036d','04c9d6790b08f6f75a3fc51b7d0f4f59a2fc7c4437e42f526133e313ada7e81c');
INSERT INTO "events" VALUES(18,'S01',1,'answered','{"fabric":"F03"}',15000000000,'2000-01-01T00:00:15.000Z','04c9d6790b08f6f75a3fc51b7d0f4f59a2fc7c4437e42f526133e313ada7e81c','5931a642c02c889a217c5b07b506abf83c1aa8c8d4f2512d3ca352f65e92ca6a');
INSERT INTO "events" VALUES(19,'S01',1,'break_ended','{}',15000000000,'2000-01-01T00:00:15.000Z','5931a642c02c889a217c5b07b506abf83c1aa8c8d4f2512d3ca352f65e92ca6a','6de7aba36ba1ed445bc6e462b791d32fce46c0bfd4b4e19d429af015b43ae464');
INSERT INTO "events" VALUES(20,'S01',1,'tray_ready','{}',15000000000,'2000-01-01T00:00:15.000Z','6de7aba36ba1ed445bc6e462b791d32fce46c0bfd4b4e19d429af015b43ae464','1996c683d7d57944d9e9616460125bb21221d5888193b58a541713eb343eb2f7');
INSERT INTO "events" VALUES(21,'S01',1,'touched','{}',16250000000,'2000-01-01T00:00:16.250Z','1996c683d7d57944d9e9616460125bb21221d5888193b58a541713eb343eb2f7','48ee188ed0d42e06a7d6b81ba0d44eff07339ceece7ee8b48261af8a3dc07608');
INSERT INTO "events" VALUES(22,'S01',1,'answered','{"fabric":"F03"}',18750000000,'2000-01-01T00:00:18.750Z','48ee188ed0d42e06a7d6b81ba0d44eff07339ceece7ee8b48261af8a3dc07608','b50309f0952861b9d686bf7edc0ef6b46f81542a011650f31bdac3951450b4ef');
INSERT INTO "events" VALUES(23,'S01',1,'tray_ready','{}',18750000000,'2000-01-01T00:00:18.750Z','b50309f0952861b9d686bf7edc0ef6b46f81542a011650f31bdac3951450b4ef','70c2f043c0fa0d6a21a1fab81a68a721e841c73de296dba485af388576be0047');
INSERT INTO "events" VALUES(24,'S01',1,'touched','{}',20000000000,'2000-01-01T00:00:20.000Z','70c2f043c0fa0d6a21a1fab81a68a721e841c73de296dba485af388576be0047','26733eb9288f2e9f90f2d6df818bc169d74c5883ebec69c12f6395069e9a3d66');
INSERT INTO "events" VALUES(25,'S01',1,'answered','{"fabric":"F02"}',22500000000,'2000-01-01T00:00:22.500Z','26733eb9288f2e9f90f2d6df818bc169d74c5883ebec69c12f6395069e9a3d66','6e16b0320e00572342983746a0a48253ae3b8757d4810eb3a2fd10e309802575');
INSERT INTO "events" VALUES(26,'S01',1,'break_ended','{}',22500000000,'2000-01-01T00:00:22.500Z','6e16b0320e00572342983746a0a48253ae3b8757d4810eb3a2fd10e309802575','27969a091b903801ffc492dbac59fb29c08416c5296588e8adff5cffbcfe5914');
INSERT INTO "events" VALUES(27,'S01',1,'tray_ready','{}',22500000000,'2000-01-01T00:00:22.500Z','27969a091b903801ffc492dbac59fb29c08416c5296588e8adff5cffbcfe5914','c4529da39d035233fa72a4512a4f98221ccb2ebce3d7b08d2af1aac7ce24d1b5');
INSERT INTO "events" VALUES(28,'S01',1,'touched','{}',23750000000,'2000-01-01T00:00:23.750Z','c4529da39d035233fa72a4512a4f98221ccb2ebce3d7b08d2af1aac7ce24d1b5','2f40b1b1764226acaf6ca8194a049dfc0447c7764e4f9a9b9dbb397933eaea7c');
INSERT INTO "events" VALUES(29,'S01',1,'answered','{"tenths":79}',26250000000,'2000-01-01T00:00:26.250Z','2f40b1b1764226acaf6ca8194a049dfc0447c7764e4f9a9b9dbb397933eaea7c','e08d3823b6a53580f25b8786fd3b32721800c9f37613c3d98a6298d31f448982');
INSERT INTO "events" VALUES(30,'S01',1,'answered','{"tenths":75}',30000000000,'2000-01-01T00:00:30.000Z','e08d3823b6a53580f25b8786fd3b32721800c9f37613c3d98a6298d31f448982','d9f22bbbdc7ca314ed1f38187b7e8a75bc71258876d6379e1310ce013b613cd9');
INSERT INTO "events" VALUES(31,'S01',1,'answered','{"tenths":55}',33750000000,'2000-01-01T00:00:33.750Z','d9f22bbbdc7ca314ed1f38187b7e8a75bc71258876d6379e1310ce013b613cd9','b42db510d2c07ea866f2e0f56e6f44589c38e330b326ef5e901d4b65ca45c91e');
INSERT INTO "events" VALUES(32,'S01',1,'tray_ready','{}',33750000000,'2000-01-01T00:00:33.750Z','b42db510d2c07ea866f2e0f56e6f44589c38e330b326ef5e901d4b65ca45c91e','ea4d8b8a9d17e12799896702bbb181e27bec38c04c719578251bc0fdaf18e446');
INSERT INTO "events" VALUES(33,'S01',1,'touched','{}',35000000000,'2000-01-01T00:00:35.000Z','ea4d8b8a9d17e12799896702bbb181e27bec38c04c719578251bc0fdaf18e446','7d75c38c3132e6d1a0fd0bfc605789ec6f1c5873639a2af05b1134b9a4c5463f');
INSERT INTO "events" VALUES(34,'S01',1,'answered','{"tenths":40}',37500000000,'2000-01-01T00:00:37.500Z','7d75c38c3132e6d1a0fd0bfc605789ec6f1c5873639a2af05b1134b9a4c5463f','1088942f1a25773932ed26e8e3e53ba6a53f687785e7b5132af8057c0a4d2680');
INSERT INTO "events" VALUES(35,'S01',1,'answered','{"tenths":36}',41250000000,'2000-01-01T00:00:41.250Z','1088942f1a25773932ed26e8e3e53ba6a53f687785e7b5132af8057c0a4d2680','dad05c84aa80487775b902154e4959637c75fdbf61f7c764feedcba1393fe8b5');
INSERT INTO "events" VALUES(36,'S01',1,'answered','{"tenths":16}',45000000000,'2000-01-01T00:00:45.000Z','dad05c84aa80487775b902154e4959637c75fdbf61f7c764feedcba1393fe8b5','7c5e0c05724308eaee973413655b771a72f0b902be4743dcb293e7ec6959efa9');
INSERT INTO "events" VALUES(37,'S01',1,'tray_ready','{}',45000000000,'2000-01-01T00:00:45.000Z','7c5e0c05724308eaee973413655b771a72f0b902be4743dcb293e7ec6959efa9','3205159a786d6172ee46fb8b6b386e4c55eea6c3dbd32065d6bfb481160f2861');
INSERT INTO "events" VALUES(38,'S01',1,'touched','{}',46250000000,'2000-01-01T00:00:46.250Z','3205159a786d6172ee46fb8b6b386e4c55eea6c3dbd32065d6bfb481160f2861','ba720c6e53f6c5cde5cc9f8222ef8a838b3f06439c2e0ee11fc71fdecd7af1aa');
INSERT INTO "events" VALUES(39,'S01',1,'answered','{"tenths":22}',48750000000,'2000-01-01T00:00:48.750Z','ba720c6e53f6c5cde5cc9f8222ef8a838b3f06439c2e0ee11fc71fdecd7af1aa','c940eff211f691aa6b88ba9fa52d372ad74d99b8113fff2396228eb61e575fbc');
INSERT INTO "events" VALUES(40,'S01',1,'answered','{"tenths":26}',52500000000,'2000-01-01T00:00:52.500Z','c940eff211f691aa6b88ba9fa52d372ad74d99b8113fff2396228eb61e575fbc','95815db0948f50f40102a6380f6eb98d53768b234b7d333b329b7e4e1e11cb84');
INSERT INTO "events" VALUES(41,'S01',1,'answered','{"tenths":46}',56250000000,'2000-01-01T00:00:56.250Z','95815db0948f50f40102a6380f6eb98d53768b234b7d333b329b7e4e1e11cb84','3bf648a4810db22331f44ee82fe4f2a7cf737fb71e870ac05a6d4a24f6e9c28d');
INSERT INTO "events" VALUES(42,'S01',1,'tray_ready','{}',56250000000,'2000-01-01T00:00:56.250Z','3bf648a4810db22331f44ee82fe4f2a7cf737fb71e870ac05a6d4a24f6e9c28d','5c2d1fe56a25fd534d0d3f75865fcf8a0846662a8ac54a2bdc5907fce5486680');
INSERT INTO "events" VALUES(43,'S01',1,'touched','{}',57500000000,'2000-01-01T00:00:57.500Z','5c2d1fe56a25fd534d0d3f75865fcf8a0846662a8ac54a2bdc5907fce5486680','e7b4927dbdca744c10cc9ed2f3e45565e57a6ad15a532e9517830aa759cfe311');
INSERT INTO "events" VALUES(44,'S01',1,'answered','{"tenths":46}',60000000000,'2000-01-01T00:01:00.000Z','e7b4927dbdca744c10cc9ed2f3e45565e57a6ad15a532e9517830aa759cfe311','276f3d8b206bae41a9d8b785e44e0c66267626ac2276e5738f9cdea609a53b2f');
INSERT INTO "events" VALUES(45,'S01',1,'answered','{"tenths":42}',63750000000,'2000-01-01T00:01:03.750Z','276f3d8b206bae41a9d8b785e44e0c66267626ac2276e5738f9cdea609a53b2f','eb4d3b9d994cb87172d45458e02d3c95fcdf21398f3850e5492b2800fbb8fac7');
INSERT INTO "events" VALUES(46,'S01',1,'answered','{"tenths":22}',67500000000,'2000-01-01T00:01:07.500Z','eb4d3b9d994cb87172d45458e02d3c95fcdf21398f3850e5492b2800fbb8fac7','359863918f05e4c5fe0be35299bc0a773a4573b79caf44c4d94f56017943170b');
INSERT INTO "events" VALUES(47,'S01',1,'break_ended','{}',67500000000,'2000-01-01T00:01:07.500Z','359863918f05e4c5fe0be35299bc0a773a4573b79caf44c4d94f56017943170b','8a99c8c5414152b0f22f1c0a26df323ccd91310a15c037143999d67c034c34f0');
INSERT INTO "events" VALUES(48,'S01',1,'tray_ready','{}',67500000000,'2000-01-01T00:01:07.500Z','8a99c8c5414152b0f22f1c0a26df323ccd91310a15c037143999d67c034c34f0','3c6b17f404ba27928903478745e1ddaaca8e6cb4aeffdc755ca07d5610212029');
INSERT INTO "events" VALUES(49,'S01',1,'touched','{}',68750000000,'2000-01-01T00:01:08.750Z','3c6b17f404ba27928903478745e1ddaaca8e6cb4aeffdc755ca07d5610212029','d582bd87bedf455047cfb7815d9f5866db6e40b2bcafd29a3e40315ecf67878d');
INSERT INTO "events" VALUES(50,'S01',1,'answered','{"tenths":48}',71250000000,'2000-01-01T00:01:11.250Z','d582bd87bedf455047cfb7815d9f5866db6e40b2bcafd29a3e40315ecf67878d','7a0d9bba14cd93db425506041be47d80570e2dde18817912ca93aa98662630fc');
INSERT INTO "events" VALUES(51,'S01',1,'answered','{"tenths":44}',75000000000,'2000-01-01T00:01:15.000Z','7a0d9bba14cd93db425506041be47d80570e2dde18817912ca93aa98662630fc','417eb019beddb704eb258f4d8f61ddfa18360088d62056137cab34c95f8e81a0');
INSERT INTO "events" VALUES(52,'S01',1,'answered','{"tenths":56}',78750000000,'2000-01-01T00:01:18.750Z','417eb019beddb704eb258f4d8f61ddfa18360088d62056137cab34c95f8e81a0','739477f347a943d5fb2a9dc5483ca38b892e25361df416156bcaefb41178ae5d');
INSERT INTO "events" VALUES(53,'S01',1,'tray_ready','{}',78750000000,'2000-01-01T00:01:18.750Z','739477f347a943d5fb2a9dc5483ca38b892e25361df416156bcaefb41178ae5d','1be4e3274d4e1977dfe8fbcbe299c310bb13d4548179f40522bd88185e336b64');
INSERT INTO "events" VALUES(54,'S01',1,'touched','{}',80000000000,'2000-01-01T00:01:20.000Z','1be4e3274d4e1977dfe8fbcbe299c310bb13d4548179f40522bd88185e336b64','6c231498463a0b2489d739e8ec9804fdc7f5a40d8617d6ee7628d8a36a066f81');
INSERT INTO "events" VALUES(55,'S01',1,'answered','{"tenths":1}',82500000000,'2000-01-01T00:01:22.500Z','6c231498463a0b2489d739e8ec9804fdc7f5a40d8617d6ee7628d8a36a066f81','5b92455eebfc1baf256947092715ba4d1cac3df13398f0b1d40ef8a79e193740');
INSERT INTO "events" VALUES(56,'S01',1,'answered','{"tenths":5}',86250000000,'2000-01-01T00:01:26.250Z','5b92455eebfc1baf256947092715ba4d1cac3df13398f0b1d40ef8a79e193740','2805af3a01caab5b60718900d9d874be9fcb7cdd3de74cf82274867b45215d95');
INSERT INTO "events" VALUES(57,'S01',1,'answered','{"tenths":9}',90000000000,'2000-01-01T00:01:30.000Z','2805af3a01caab5b60718900d9d874be9fcb7cdd3de74cf82274867b45215d95','e7633e94e82f58b8f2f4690a1a8e44d2413e0064d6df7bce0f38f66c0432250f');
CREATE TABLE fabrics(position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, name TEXT NOT NULL) STRICT;
INSERT INTO "fabrics" VALUES(1,'F01','fabric 01');
INSERT INTO "fabrics" VALUES(2,'F02','fabric 02');
INSERT INTO "fabrics" VALUES(3,'F03','fabric 03');
CREATE TABLE notes(
        id INTEGER PRIMARY KEY, event INTEGER NOT NULL REFERENCES events(sequence),
        participant TEXT NOT NULL REFERENCES participants(id), trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
        question TEXT, text TEXT NOT NULL) STRICT;
CREATE TABLE participants(
        id TEXT PRIMARY KEY, slot INTEGER NOT NULL UNIQUE REFERENCES slots(number),
        kind TEXT NOT NULL CHECK (kind IN ('human', 'scripted', 'simulated')),
        state TEXT NOT NULL CHECK (state IN ('started', 'finished', 'withdrawn'))) STRICT;
INSERT INTO "participants" VALUES('S01',1,'scripted','finished');
CREATE TABLE responses(
        id INTEGER PRIMARY KEY, event INTEGER NOT NULL REFERENCES events(sequence),
        participant TEXT NOT NULL REFERENCES participants(id), trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
        question TEXT NOT NULL, file_code TEXT NOT NULL REFERENCES stimuli(file_code), alternatives TEXT NOT NULL,
        choice TEXT, rating_tenths INTEGER, ready_at INTEGER NOT NULL, touched_at INTEGER,
        answered_at INTEGER NOT NULL, stored_at INTEGER NOT NULL, is_correction INTEGER NOT NULL,
        CHECK ((choice IS NULL) <> (rating_tenths IS NULL))) STRICT;
INSERT INTO "responses" VALUES(1,9,'S01',1,1,'Q1','sh5suc2g','["F02","F01","F03"]','F01',NULL,0,1250000000,3750000000,3750000000,0);
INSERT INTO "responses" VALUES(2,12,'S01',2,1,'Q1','t5fnqt4j','["F03","F02","F01"]','F03',NULL,3750000000,5000000000,7500000000,7500000000,0);
INSERT INTO "responses" VALUES(3,15,'S01',3,1,'Q1','d5ea87q6','["F02","F03","F01"]','F01',NULL,7500000000,8750000000,11250000000,11250000000,0);
INSERT INTO "responses" VALUES(4,18,'S01',4,1,'Q1','rauk6wjp','["F01","F03","F02"]','F03',NULL,11250000000,12500000000,15000000000,15000000000,0);
INSERT INTO "responses" VALUES(5,22,'S01',5,1,'Q1','xu3vhggq','["F03","F01","F02"]','F03',NULL,15000000000,16250000000,18750000000,18750000000,0);
INSERT INTO "responses" VALUES(6,25,'S01',6,1,'Q1','uupz43uy','["F03","F02","F01"]','F02',NULL,18750000000,20000000000,22500000000,22500000000,0);
INSERT INTO "responses" VALUES(7,29,'S01',7,1,'Q2','xu3vhggq','["F01"]',NULL,79,22500000000,23750000000,26250000000,26250000000,0);
INSERT INTO "responses" VALUES(8,30,'S01',7,1,'Q3','xu3vhggq','["F01"]',NULL,75,26250000000,NULL,30000000000,30000000000,0);
INSERT INTO "responses" VALUES(9,31,'S01',7,1,'Q4','xu3vhggq','["F01"]',NULL,55,30000000000,NULL,33750000000,33750000000,0);
INSERT INTO "responses" VALUES(10,34,'S01',8,1,'Q2','rauk6wjp','["F02"]',NULL,40,33750000000,35000000000,37500000000,37500000000,0);
INSERT INTO "responses" VALUES(11,35,'S01',8,1,'Q3','rauk6wjp','["F02"]',NULL,36,37500000000,NULL,41250000000,41250000000,0);
INSERT INTO "responses" VALUES(12,36,'S01',8,1,'Q4','rauk6wjp','["F02"]',NULL,16,41250000000,NULL,45000000000,45000000000,0);
INSERT INTO "responses" VALUES(13,39,'S01',9,1,'Q2','d5ea87q6','["F03"]',NULL,22,45000000000,46250000000,48750000000,48750000000,0);
INSERT INTO "responses" VALUES(14,40,'S01',9,1,'Q3','d5ea87q6','["F03"]',NULL,26,48750000000,NULL,52500000000,52500000000,0);
INSERT INTO "responses" VALUES(15,41,'S01',9,1,'Q4','d5ea87q6','["F03"]',NULL,46,52500000000,NULL,56250000000,56250000000,0);
INSERT INTO "responses" VALUES(16,44,'S01',10,1,'Q2','t5fnqt4j','["F01"]',NULL,46,56250000000,57500000000,60000000000,60000000000,0);
INSERT INTO "responses" VALUES(17,45,'S01',10,1,'Q3','t5fnqt4j','["F01"]',NULL,42,60000000000,NULL,63750000000,63750000000,0);
INSERT INTO "responses" VALUES(18,46,'S01',10,1,'Q4','t5fnqt4j','["F01"]',NULL,22,63750000000,NULL,67500000000,67500000000,0);
INSERT INTO "responses" VALUES(19,50,'S01',11,1,'Q2','sh5suc2g','["F02"]',NULL,48,67500000000,68750000000,71250000000,71250000000,0);
INSERT INTO "responses" VALUES(20,51,'S01',11,1,'Q3','sh5suc2g','["F02"]',NULL,44,71250000000,NULL,75000000000,75000000000,0);
INSERT INTO "responses" VALUES(21,52,'S01',11,1,'Q4','sh5suc2g','["F02"]',NULL,56,75000000000,NULL,78750000000,78750000000,0);
INSERT INTO "responses" VALUES(22,55,'S01',12,1,'Q2','uupz43uy','["F03"]',NULL,1,78750000000,80000000000,82500000000,82500000000,0);
INSERT INTO "responses" VALUES(23,56,'S01',12,1,'Q3','uupz43uy','["F03"]',NULL,5,82500000000,NULL,86250000000,86250000000,0);
INSERT INTO "responses" VALUES(24,57,'S01',12,1,'Q4','uupz43uy','["F03"]',NULL,9,86250000000,NULL,90000000000,90000000000,0);
CREATE TABLE slots(number INTEGER PRIMARY KEY CHECK (number >= 1)) STRICT;
INSERT INTO "slots" VALUES(1);
INSERT INTO "slots" VALUES(2);
CREATE TABLE stimuli(file_code TEXT PRIMARY KEY, sha256 TEXT NOT NULL) STRICT;
INSERT INTO "stimuli" VALUES('d5ea87q6','c410cbb324e23a4d99280838483d298853ca190dd91c1e40b59d36d5303083eb');
INSERT INTO "stimuli" VALUES('rauk6wjp','ad5c4e9df14f55d266fb9c16d50780c25846afd49cfed4d5ebb4f3395c8ae703');
INSERT INTO "stimuli" VALUES('sh5suc2g','be7acc6a039e36e9b289352704ff22b5500674daa5b4fe52a4c90ae8f10ed8af');
INSERT INTO "stimuli" VALUES('t5fnqt4j','56889493f868bc28327e900f7e40c0a5e43fe77d7916e02e0bbf030edde66d98');
INSERT INTO "stimuli" VALUES('uupz43uy','0966a89777dab935c2e9bf4d71a13ca87e499188bf2d4381116121f150daccb0');
INSERT INTO "stimuli" VALUES('xu3vhggq','461d3d6fbffc6af24666fb67ee2f1fb64b0c06dea6c5258fa253ce582ee962f1');
CREATE TABLE study(
        id INTEGER PRIMARY KEY CHECK (id = 1), name TEXT NOT NULL,
        protocol_json TEXT NOT NULL, protocol_sha256 TEXT NOT NULL, design_seed TEXT NOT NULL,
        key_sha256 TEXT NOT NULL, masked_key_sha256 TEXT NOT NULL,
        dataset_path TEXT NOT NULL, dataset_sha256 TEXT NOT NULL, dataset_procedural INTEGER NOT NULL,
        model_sha256 TEXT NOT NULL, stamps TEXT NOT NULL, signals_json TEXT NOT NULL,
        created_at TEXT NOT NULL, program_version TEXT NOT NULL) STRICT;
INSERT INTO "study" VALUES(1,'Small study','{
  "schema": "vis2hap.protocol/1",
  "name": "Small study",
  "participants": 2,
  "fabrics": [
    "F01",
    "F02",
    "F03"
  ],
  "conditions": [
    "v_grey",
    "h&f"
  ],
  "phases": [
    {
      "questions": [
        "Q1"
      ],
      "alternatives": 3
    },
    {
      "questions": [
        "Q2",
        "Q3",
        "Q4"
      ],
      "scale": {
        "min": 0,
        "max": 10,
        "step": 0.1,
        "sections": 9
      }
    }
  ],
  "seconds_per_presentation": 30,
  "break_after": 4
}','f4e4e9e9641f31e26cc8496e0cfea9d2088455fc87a96a676c4512e561a79e50','1','c515e1fd4ab06fdc4701d40717dacac984c213f0a20c7ae70906b7d2b39ee5f3','d6cce56f809e88e89eab4a78fdf8f4eed4fb22e670e06dfef00abf0bf47b4e99','','',1,'','[]','{}','2000-01-01T00:00:00.000Z','test');
CREATE TABLE trials(
        slot INTEGER NOT NULL REFERENCES slots(number), number INTEGER NOT NULL CHECK (number >= 1),
        phase INTEGER NOT NULL, file_code TEXT NOT NULL REFERENCES stimuli(file_code),
        presentation_code TEXT NOT NULL, alternatives TEXT NOT NULL,
        PRIMARY KEY (slot, number)) STRICT, WITHOUT ROWID;
INSERT INTO "trials" VALUES(1,1,0,'sh5suc2g','FTPV','["F02","F01","F03"]');
INSERT INTO "trials" VALUES(1,2,0,'t5fnqt4j','MKME','["F03","F02","F01"]');
INSERT INTO "trials" VALUES(1,3,0,'d5ea87q6','FKPY','["F02","F03","F01"]');
INSERT INTO "trials" VALUES(1,4,0,'rauk6wjp','RUPN','["F01","F03","F02"]');
INSERT INTO "trials" VALUES(1,5,0,'xu3vhggq','FPEX','["F03","F01","F02"]');
INSERT INTO "trials" VALUES(1,6,0,'uupz43uy','AXYV','["F03","F02","F01"]');
INSERT INTO "trials" VALUES(1,7,1,'xu3vhggq','APMY','["F01"]');
INSERT INTO "trials" VALUES(1,8,1,'rauk6wjp','YARM','["F02"]');
INSERT INTO "trials" VALUES(1,9,1,'d5ea87q6','NHHT','["F03"]');
INSERT INTO "trials" VALUES(1,10,1,'t5fnqt4j','RCH4','["F01"]');
INSERT INTO "trials" VALUES(1,11,1,'sh5suc2g','JL43','["F02"]');
INSERT INTO "trials" VALUES(1,12,1,'uupz43uy','RU9P','["F03"]');
INSERT INTO "trials" VALUES(2,1,0,'sh5suc2g','EMXC','["F01","F03","F02"]');
INSERT INTO "trials" VALUES(2,2,0,'uupz43uy','3JNP','["F02","F03","F01"]');
INSERT INTO "trials" VALUES(2,3,0,'xu3vhggq','RMWL','["F03","F02","F01"]');
INSERT INTO "trials" VALUES(2,4,0,'rauk6wjp','EEWP','["F02","F01","F03"]');
INSERT INTO "trials" VALUES(2,5,0,'d5ea87q6','JTE4','["F03","F01","F02"]');
INSERT INTO "trials" VALUES(2,6,0,'t5fnqt4j','9VEM','["F03","F01","F02"]');
INSERT INTO "trials" VALUES(2,7,1,'t5fnqt4j','JUC7','["F01"]');
INSERT INTO "trials" VALUES(2,8,1,'d5ea87q6','XVUN','["F03"]');
INSERT INTO "trials" VALUES(2,9,1,'rauk6wjp','EMN9','["F02"]');
INSERT INTO "trials" VALUES(2,10,1,'xu3vhggq','CK3C','["F01"]');
INSERT INTO "trials" VALUES(2,11,1,'uupz43uy','VJKC','["F03"]');
INSERT INTO "trials" VALUES(2,12,1,'sh5suc2g','KLMX','["F02"]');
CREATE TABLE unblindings(
        event INTEGER PRIMARY KEY REFERENCES events(sequence), who TEXT NOT NULL, why TEXT NOT NULL,
        wall_time TEXT NOT NULL) STRICT;
CREATE TABLE voids(
        event INTEGER NOT NULL REFERENCES events(sequence), participant TEXT NOT NULL REFERENCES participants(id),
        trial INTEGER NOT NULL, attempt INTEGER NOT NULL, PRIMARY KEY (participant, trial, attempt)) STRICT;
CREATE INDEX events_of_participant ON events(participant, sequence);
CREATE INDEX responses_of_question ON responses(participant, trial, attempt, question, id);
CREATE UNIQUE INDEX one_first_answer ON responses(participant, trial, attempt, question) WHERE is_correction = 0;
CREATE INDEX notes_of_trial ON notes(participant, trial, attempt);
CREATE VIEW current_responses AS SELECT
        p.slot AS slot, first.id AS first_id, first.attempt AS attempt, first.participant AS participant,
        first.trial AS trial, first.question AS question, first.file_code AS file_code,
        first.alternatives AS alternatives, latest.choice AS choice, latest.rating_tenths AS rating_tenths,
        first.ready_at AS ready_at, first.touched_at AS touched_at, first.answered_at AS answered_at,
        latest.stored_at AS stored_at,
        (SELECT COUNT(*) FROM responses r WHERE r.participant = first.participant AND r.trial = first.trial
            AND r.attempt = first.attempt AND r.question = first.question) - 1 AS corrections,
        EXISTS (SELECT 1 FROM voids v WHERE v.participant = first.participant AND v.trial = first.trial
            AND v.attempt = first.attempt) AS voided,
        e.wall_time AS wall_time,
        COALESCE((SELECT group_concat(text, '; ') FROM (SELECT n.text AS text FROM notes n
            WHERE n.participant = first.participant AND n.trial = first.trial AND n.attempt = first.attempt
            AND (n.question IS NULL OR n.question = first.question) ORDER BY n.id)), '') AS note
      FROM responses first
      JOIN participants p ON p.id = first.participant
      JOIN responses latest ON latest.id = (SELECT MAX(r.id) FROM responses r WHERE r.participant = first.participant
            AND r.trial = first.trial AND r.attempt = first.attempt AND r.question = first.question)
      JOIN events e ON e.sequence = latest.event
      WHERE first.is_correction = 0;
CREATE VIEW answers AS SELECT participant, trial, question, file_code, alternatives, choice AS answer,
        rating_tenths / 10.0 AS rating, ready_at, touched_at, answered_at, stored_at,
        (answered_at - COALESCE(touched_at, ready_at)) / 1e9 AS seconds, corrections, voided, wall_time, note
      FROM current_responses ORDER BY slot, trial, first_id;
CREATE TRIGGER study_no_UPDATE BEFORE UPDATE ON study BEGIN SELECT RAISE(ABORT, 'study is append-only'); END;
CREATE TRIGGER study_no_DELETE BEFORE DELETE ON study BEGIN SELECT RAISE(ABORT, 'study is append-only'); END;
CREATE TRIGGER fabrics_no_UPDATE BEFORE UPDATE ON fabrics BEGIN SELECT RAISE(ABORT, 'fabrics is append-only'); END;
CREATE TRIGGER fabrics_no_DELETE BEFORE DELETE ON fabrics BEGIN SELECT RAISE(ABORT, 'fabrics is append-only'); END;
CREATE TRIGGER stimuli_no_UPDATE BEFORE UPDATE ON stimuli BEGIN SELECT RAISE(ABORT, 'stimuli is append-only'); END;
CREATE TRIGGER stimuli_no_DELETE BEFORE DELETE ON stimuli BEGIN SELECT RAISE(ABORT, 'stimuli is append-only'); END;
CREATE TRIGGER slots_no_UPDATE BEFORE UPDATE ON slots BEGIN SELECT RAISE(ABORT, 'slots is append-only'); END;
CREATE TRIGGER slots_no_DELETE BEFORE DELETE ON slots BEGIN SELECT RAISE(ABORT, 'slots is append-only'); END;
CREATE TRIGGER trials_no_UPDATE BEFORE UPDATE ON trials BEGIN SELECT RAISE(ABORT, 'trials is append-only'); END;
CREATE TRIGGER trials_no_DELETE BEFORE DELETE ON trials BEGIN SELECT RAISE(ABORT, 'trials is append-only'); END;
CREATE TRIGGER events_no_UPDATE BEFORE UPDATE ON events BEGIN SELECT RAISE(ABORT, 'events is append-only'); END;
CREATE TRIGGER events_no_DELETE BEFORE DELETE ON events BEGIN SELECT RAISE(ABORT, 'events is append-only'); END;
CREATE TRIGGER responses_no_UPDATE BEFORE UPDATE ON responses BEGIN SELECT RAISE(ABORT, 'responses is append-only'); END;
CREATE TRIGGER responses_no_DELETE BEFORE DELETE ON responses BEGIN SELECT RAISE(ABORT, 'responses is append-only'); END;
CREATE TRIGGER voids_no_UPDATE BEFORE UPDATE ON voids BEGIN SELECT RAISE(ABORT, 'voids is append-only'); END;
CREATE TRIGGER voids_no_DELETE BEFORE DELETE ON voids BEGIN SELECT RAISE(ABORT, 'voids is append-only'); END;
CREATE TRIGGER notes_no_UPDATE BEFORE UPDATE ON notes BEGIN SELECT RAISE(ABORT, 'notes is append-only'); END;
CREATE TRIGGER notes_no_DELETE BEFORE DELETE ON notes BEGIN SELECT RAISE(ABORT, 'notes is append-only'); END;
CREATE TRIGGER unblindings_no_UPDATE BEFORE UPDATE ON unblindings BEGIN SELECT RAISE(ABORT, 'unblindings is append-only'); END;
CREATE TRIGGER unblindings_no_DELETE BEFORE DELETE ON unblindings BEGIN SELECT RAISE(ABORT, 'unblindings is append-only'); END;
DELETE FROM "sqlite_sequence";
INSERT INTO "sqlite_sequence" VALUES('events',57);
COMMIT;

include Dolphin_utf8.Utf8

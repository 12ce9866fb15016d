let () = print_string (Dolphin_syntax.Prelude.manual ())

module Numeral = Dolphin_numerals.Numeral
module Percent_encoding = Dolphin_numerals.Percent_encoding
module Property = Test_support.Property
module Gen = QCheck2.Gen

let number text expected () = Alcotest.(check (option (float 0.))) text expected (Numeral.number text)
let whole text expected () = Alcotest.(check (option int)) text expected (Numeral.whole text)

let known () =
  List.iter
    (fun (text, expected) -> number text expected ())
    [ ("0", Some 0.); ("-8.7", Some (-8.7)); ("+1", Some 1.); (".5", Some 0.5); ("5.", Some 5.); ("1e3", Some 1000.);
      ("1.5E-3", Some 0.0015); ("1e+2", Some 100.); ("", None); ("-", None); (".", None); ("-.", None); ("e3", None);
      ("1e", None); ("1e+", None); ("0x29", None); ("-8_7", None); ("4_1", None); ("nan", None); ("inf", None);
      ("infinity", None); ("1e999", None); ("0x1p3", None); ("1.2.3", None); (" 1", None); ("1 ", None); ("1f", None);
      ("--1", None); ("1\000", None) ];
  List.iter
    (fun (text, expected) -> whole text expected ())
    [ ("0", Some 0); ("-12", Some (-12)); ("+12", Some 12); ("007", Some 7); ("", None); ("+", None); ("1_0", None);
      ("0x1f", None); ("0b1", None); ("0u1", None); ("0o7", None); ("1.", None); ("99999999999999999999", None);
      ("4611686018427387903", Some max_int); ("-4611686018427387904", Some min_int) ];
  let hexadecimal text = Numeral.whole_or_hexadecimal text in
  Alcotest.(check (list (option int))) "hexadecimal" [ Some 31; Some 31; Some 31; None; None; None ]
    (List.map hexadecimal [ "0x1f"; "0X1F"; "31"; "0x"; "0x1_f"; "-0x1f" ])

let printed_is_read =
  Property.case ~count:2000 "what is printed is read" ~print:string_of_float Gen.float (fun x ->
      if not (Float.is_finite x) then Numeral.number (Printf.sprintf "%.17g" x) = None
      else Numeral.number (Printf.sprintf "%.17g" x) = Some x && Numeral.number (Printf.sprintf "%.17e" x) = Some x)

let whole_is_read =
  Property.case ~count:2000 "whole numbers are read" ~print:string_of_int Gen.int (fun n ->
      Numeral.whole (string_of_int n) = Some n
      && Numeral.whole_or_hexadecimal (Printf.sprintf "0x%x" (abs n land max_int)) = Some (abs n land max_int))

let characters = Gen.oneofl [ '0'; '7'; '.'; 'e'; 'E'; '-'; '+'; '_'; 'x'; 'n'; 'a'; ' '; 'f'; 'p' ]

let texts = Gen.(string_size ~gen:characters (int_range 0 7))

(* The grammar, by cutting: a sign, then the power, then the point. *)
let by_cutting text =
  let unsigned text =
    if text <> "" && (text.[0] = '-' || text.[0] = '+') then String.sub text 1 (String.length text - 1) else text in
  let digits text = String.for_all (fun c -> c >= '0' && c <= '9') text in
  let mantissa, power =
    match String.split_on_char 'e' (String.lowercase_ascii (unsigned text)) with
    | [ mantissa ] -> (mantissa, "0")
    | [ mantissa; power ] -> (mantissa, unsigned power)
    | _ -> ("", "")
  in
  let of_mantissa =
    match String.split_on_char '.' mantissa with
    | [ whole ] -> whole <> "" && digits whole
    | [ whole; rest ] -> whole ^ rest <> "" && digits whole && digits rest
    | _ -> false
  in
  of_mantissa && power <> "" && digits power

let only_numbers_are_read =
  Property.case ~count:20000 "only numbers are read" ~print:Fun.id texts (fun text ->
      match Numeral.number text with
      | Some x -> by_cutting text && float_of_string text = x
      | None -> (not (by_cutting text)) || not (Float.is_finite (float_of_string text)))

let percent () =
  let check text expected = Alcotest.(check (option string)) text expected (Percent_encoding.decoded text) in
  check "no%20fly%2Bzone.kml" (Some "no fly+zone.kml");
  check "%c3%A9" (Some "\xc3\xa9");
  check "%2520" (Some "%20");
  List.iter (fun text -> check text None) [ "%"; "a%2"; "%2g"; "%-1"; "%0x"; "100% sure" ]

let encoded_is_decoded =
  let encoded text =
    let byte c = Printf.sprintf "%%%02x" (Char.code c) in
    String.concat "" (List.map byte (List.of_seq (String.to_seq text)))
  in
  Property.case ~count:2000 "what is encoded is decoded" ~print:String.escaped Gen.string (fun text ->
      Percent_encoding.decoded (encoded text) = Some text)

let () =
  Alcotest.run "numerals"
    [ ("numerals",
       [ Alcotest.test_case "known" `Quick known; printed_is_read; whole_is_read; only_numbers_are_read ]);
      ("percent-encoding", [ Alcotest.test_case "known" `Quick percent; encoded_is_decoded ]) ]

open Dolphin_runtime
open Lwt.Infix

let case name test = Alcotest.test_case name `Quick (fun () -> Lwt_main.run (test ()))

let write output text =
  Lwt_unix.write_string output text 0 (String.length text) >>= fun written ->
  Alcotest.(check int) "written" (String.length text) written;
  Lwt.return_unit

let line =
  let pp ppf = function
    | Lines.Line text -> Format.fprintf ppf "%S" text
    | Too_long -> Format.pp_print_string ppf "too long"
    | End_of_input -> Format.pp_print_string ppf "end"
  in
  Alcotest.testable pp ( = )

let next_is lines expected = Lines.next lines >|= Alcotest.check line "line" expected

let reads_lines () =
  let input, output = Lwt_unix.pipe ~cloexec:true () in
  let lines = Lines.make ~limit:10 input in
  write output "one\r\n\n0123456789\n01234567890\nfive\n" >>= fun () ->
  next_is lines (Line "one") >>= fun () ->
  next_is lines (Line "") >>= fun () ->
  next_is lines (Line "0123456789") >>= fun () ->
  next_is lines Too_long >>= fun () ->
  next_is lines (Line "five") >>= fun () ->
  let long = Lines.next lines in
  write output (String.make 20_000 'x') >>= fun () ->
  long >|= Alcotest.check line "before its end" Too_long >>= fun () ->
  let after = Lines.next lines in
  write output "xxx\nlast" >>= fun () ->
  Lwt_unix.close output >>= fun () ->
  after >|= Alcotest.check line "after it" (Line "last") >>= fun () ->
  next_is lines End_of_input >>= fun () -> next_is lines End_of_input

let survives_cancellation () =
  let input, output = Lwt_unix.pipe ~cloexec:true () in
  let lines = Lines.make ~limit:10 input in
  write output "fir" >>= fun () ->
  let waiting = Lines.next lines in
  Lwt_unix.sleep 0.01 >>= fun () ->
  Lwt.cancel waiting;
  Alcotest.(check bool) "cancelled" true (Lwt.state waiting = Lwt.Fail Lwt.Canceled);
  write output "st\n" >>= fun () -> next_is lines (Line "first")

let answer = Alcotest.(result string string)

let answers_in_turn () =
  let input, output = Lwt_unix.pipe ~cloexec:true () in
  let shown = Buffer.create 100 in
  let console = Console.scripted ~input ~output:(Buffer.add_string shown) ~answers:[ "1"; "2" ] () in
  let asks prompt expected = console.ask prompt >|= Alcotest.check answer prompt expected in
  asks "a?" (Ok "1") >>= fun () ->
  console.refused "too small";
  asks "a?" (Ok "2") >>= fun () ->
  write output "3\n" >>= fun () ->
  asks "b?" (Ok "3") >>= fun () ->
  Lwt_unix.close output >>= fun () ->
  asks "c?" (Error "end of input") >|= fun () ->
  console.say "bye";
  Alcotest.(check string)
    "shown" "a? 1\nThis answer cannot be taken: too small\na? 2\nb? c? \nbye\n" (Buffer.contents shown)

let tests =
  [ case "lines are read whole, and bounded" reads_lines;
    case "a cancelled line is not lost" survives_cancellation;
    case "answers come from the script, then from the input" answers_in_turn ]

open Dolphin_platform_imc

(* As Linux writes it: each address in the trees of all its tables, with broadcast addresses and networks. *)
let fib_trie =
  [ "Main:";
    "  +-- 0.0.0.0/0 3 0 5";
    "     |-- 0.0.0.0";
    "        /0 universe UNICAST";
    "     +-- 10.0.0.0/24 2 0 2";
    "        |-- 10.0.0.0";
    "           /24 link UNICAST";
    "        |-- 10.0.0.7";
    "           /32 host LOCAL";
    "        |-- 10.0.0.255";
    "           /32 link BROADCAST";
    "     +-- 127.0.0.0/8 2 0 2";
    "        |-- 127.0.0.1";
    "           /32 host LOCAL";
    "        |-- 127.0.0.53";
    "           /32 host LOCAL";
    "     |-- 192.168.1.20";
    "        /32 host LOCAL";
    "Local:";
    "     |-- 10.0.0.7";
    "        /32 host LOCAL" ]

let found lines = List.map Unix.string_of_inet_addr (Interfaces.of_fib_trie lines)
let addresses = Alcotest.(list string)

let of_this_machine_alone () =
  Alcotest.check addresses "each once, without loopback" [ "10.0.0.7"; "192.168.1.20" ] (found fib_trie)

let nothing_to_read () =
  Alcotest.check addresses "no such file" [] (found []);
  Alcotest.check addresses "something else" [] (found [ "/32 host LOCAL"; "|-- nowhere"; "/32 host LOCAL" ])

let loopback_is_last () =
  match List.rev (Interfaces.local ()) with
  | last :: others ->
    Alcotest.(check bool) "it is there" true (last = Unix.inet_addr_loopback);
    Alcotest.(check bool) "once" false (List.mem last others)
  | [] -> Alcotest.fail "no address"

let tests =
  ( "interfaces",
    [ Alcotest.test_case "addresses of this machine" `Quick of_this_machine_alone;
      Alcotest.test_case "what is no list of them" `Quick nothing_to_read;
      Alcotest.test_case "loopback is last" `Quick loopback_is_last ] )

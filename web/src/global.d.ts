/** Whether the page is the single file that opens without a server. */
declare const IS_ONE_FILE: boolean;

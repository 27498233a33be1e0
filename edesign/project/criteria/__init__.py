"""What a study is judged by."""
